# Figure 13 of the collaborative paper: both turns, all seeds; runs='turn_90_1 …' is given.
set fit quiet logfile "/dev/null"
set datafile separator ','
set grid lc rgb '#dddddd'
blue = '#0060ad'; red = '#d1495b'; gray = '#404040'
errors(run, mode) = run.'/'.mode.'/errors.csv'

set terminal pngcairo size 1100,820 font 'sans,10'
set output 'turns.png'
set multiplot layout 2,2 title 'Figure 13: turns at 0.8 m/s'
set size ratio -1
set xlabel 'x [m]'
set ylabel 'y [m]'
set key inside left top
of(run, turn) = strstrt(run, 'turn_'.turn.'_') == 1
do for [turn in '90 180'] {
  here = ''
  do for [run in runs] { if (of(run, turn)) { here = here.' '.run } }
  set xrange [-4:10]
  set yrange [turn eq '90' ? -4 : -3:turn eq '90' ? 8 : 6]
  set title turn.' degrees'
  plot for [mode in 'mono collaborative'] for [run in here] errors(run, mode) skip 1 using 6:7 with lines lw 1 \
         lc rgb (mode eq 'mono' ? blue : red) notitle, \
       for [run in here] errors(run, 'mono') skip 1 using 3:4 with lines lw 2 lc rgb gray notitle, \
       NaN with lines lw 2 lc rgb gray title 'truth', NaN with lines lw 1 lc rgb blue title 'mono', \
       NaN with lines lw 1 lc rgb red title 'collaborative'
}
set size noratio
set xrange [0:*]
set yrange [0:*]
set xlabel 't [s]'
set ylabel 'position error [m]'
set title 'position error, both turns'
plot for [mode in 'mono collaborative'] for [run in runs] errors(run, mode) skip 1 using 2:9 with lines lw 1 \
       lc rgb (mode eq 'mono' ? blue : red) notitle
set ylabel 'rotation error [deg]'
set title 'rotation error, both turns'
plot for [mode in 'mono collaborative'] for [run in runs] errors(run, mode) skip 1 using 2:10 with lines lw 1 \
       lc rgb (mode eq 'mono' ? blue : red) notitle
unset multiplot
