# The figures 14 and 15 of the collaborative paper: general sequences; runs='a b c …' is given.
set fit quiet logfile "/dev/null"
set datafile separator ','
set grid lc rgb '#dddddd'
blue = '#0060ad'; red = '#d1495b'; gray = '#404040'
errors(run, mode) = run.'/'.mode.'/errors.csv'

set terminal pngcairo size 1500,680 font 'sans,9'
set output 'general.png'
set multiplot layout 2,5 title 'Figure 14: trajectories from above (gray: truth, blue: mono, red: collaborative)'
set size ratio -1
unset key
do for [run in runs] {
  set xrange [*:*]
  set yrange [*:*]
  stats errors(run, 'mono') skip 1 using 3:4 name 'T' nooutput
  margin = 0.25 * (T_max_x - T_min_x > T_max_y - T_min_y ? T_max_x - T_min_x : T_max_y - T_min_y)
  set xrange [T_min_x - margin:T_max_x + margin]
  set yrange [T_min_y - margin:T_max_y + margin]
  set title run
  plot errors(run, 'mono') skip 1 using 3:4 with lines lw 3 lc rgb gray, \
       '' skip 1 using 6:7 with lines lw 1.5 lc rgb blue, \
       errors(run, 'collaborative') skip 1 using 6:7 with lines lw 1.5 lc rgb red
}
unset multiplot

set terminal pngcairo size 700,460 font 'sans,10'
set output 'figure15.png'
set size noratio
set title 'Figure 15: final position error against overlap'
set key inside right top
set xlabel 'overlap ratio (time with a pseudo-stereo view over total time)'
set ylabel 'final position error [m]'
set xrange [0:1]
set yrange [0:*]
n = words(runs)
plot 'runs.csv' skip 1 using (strcol(2) eq 'mono' ? 0 : NaN):(NaN) notitle, \
     '< awk -F, "NR > 1 {e[\$1, \$2] = \$3; if (\$2 == \"collaborative\") o[\$1] = \$8} END {for (r in o) print o[r] \",\" e[r, \"mono\"] \",\" e[r, \"collaborative\"] \",\" r}" runs.csv' \
       using 1:2:(0):($3-$2) with vectors nohead lc rgb '#bbbbbb' notitle, \
     '' using 1:2 with points pt 7 ps 1.4 lc rgb blue title 'mono', \
     '' using 1:3 with points pt 7 ps 1.4 lc rgb red title 'collaborative', \
     '' using 1:2:4 with labels offset 1,0.5 notitle
