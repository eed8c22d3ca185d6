# The figures 9 to 16 of the adaptive paper from this folder's csv files: one drive, each mode.
set datafile separator ','
set grid lc rgb '#dddddd'
modes = 'vins ac_g ac_gn ac_me ac_me_guarded'
array colour[5] = ['#404040', '#e08e0b', '#2a9d4a', '#0060ad', '#d1495b']

set terminal pngcairo size 1100,700 font 'sans,10'
set output 'figure9_11_trajectories.png'
set title 'Figures 9 and 11: trajectories'
set xlabel 'x [m]'
set ylabel 'y [m]'
# A street may be a thousand times as long as it is wide: equal scales only where that leaves something to see.
stats 'truth.csv' skip 1 using 2 name 'X' nooutput
stats 'truth.csv' skip 1 using 3 name 'Y' nooutput
if ((X_max - X_min) < 5 * (Y_max - Y_min) && (Y_max - Y_min) < 5 * (X_max - X_min)) { set size ratio -1 }
set key outside right top
plot 'truth.csv' skip 1 using 2:3 with lines lw 4 lc rgb '#bbbbbb' title 'truth', \
     for [i=1:5] 'path_'.word(modes, i).'.csv' skip 1 using 2:3 with lines lw 1.5 lc rgb colour[i] title word(modes, i) noenhanced
set size noratio

set terminal pngcairo size 1100,420 font 'sans,10'
set output 'figure10_12_rpe.png'
set title 'Figures 10 and 12: relative position error over one second'
set xlabel 't [s]'
set ylabel 'RPE [m]'
set yrange [0:*]
plot for [i=1:5] 'rpe_'.word(modes, i).'.csv' skip 1 using 1:2 with lines lw 1.3 lc rgb colour[i] title word(modes, i) noenhanced

set terminal pngcairo size 1100,700 font 'sans,10'
set output 'figure14_15_g_and_n.png'
set multiplot layout 2,1 title 'Figures 14 and 15: what V26 weighs with, and the error'
set y2tics
set ytics nomirror
set ylabel 'RPE [m]'
set y2range [0:5]
set title 'geometry factor g and the error of ac_g' noenhanced
set y2label 'g'
plot 'window_ac_g.csv' skip 1 using 1:2 axes x1y2 with lines lc rgb '#8fb8de' title 'g', \
     'rpe_ac_g.csv' skip 1 using 1:2 with lines lw 1.5 lc rgb colour[2] title 'ac_g' noenhanced
set y2range [0:*]
set title 'times tracked N and the error of ac_gn' noenhanced
set y2label 'N'
plot 'window_ac_gn.csv' skip 1 using 1:3 axes x1y2 with lines lc rgb '#8fb8de' title 'N, mean', \
     'rpe_ac_gn.csv' skip 1 using 1:2 with lines lw 1.5 lc rgb colour[3] title 'ac_gn' noenhanced
unset multiplot
unset y2tics
unset y2label
set ytics mirror

set terminal pngcairo size 1100,420 font 'sans,10'
set output 'figure16_residuals.png'
set title 'Figure 16: residual of the median feature without (ac_gn) and with the M-estimator (ac_me)' noenhanced
set ylabel 'residual [px]'
set logscale y
set yrange [0.1:*]
plot 'window_ac_gn.csv' skip 1 using 1:4 with lines lw 1.3 lc rgb '#d1495b' title 'ac_gn' noenhanced, \
     'window_ac_me.csv' skip 1 using 1:4 with lines lw 1.3 lc rgb '#0060ad' title 'ac_me' noenhanced

unset logscale y
set yrange [0:*]
set output 'guard.png'
set title 'The guarded mode: its error beside that of vins, and when it acts' noenhanced
set ylabel 'RPE [m]'
set style fill solid 0.3 noborder
set y2range [0:1]
plot 'window_ac_me_guarded.csv' skip 1 using 1:5 axes x1y2 with filledcurves y=0 lc rgb '#f3d9a4' title 'acts', \
     'rpe_vins.csv' skip 1 using 1:2 with lines lw 1.3 lc rgb colour[1] title 'vins' noenhanced, \
     'rpe_ac_me_guarded.csv' skip 1 using 1:2 with lines lw 1.3 lc rgb colour[5] title 'ac_me_guarded' noenhanced

if (system("test -e nees_vins.csv && echo yes") eq "yes") {
  set output 'nees.png'
  set title 'NEES of the pose, mean of the static drives; expected 6' noenhanced
  set ylabel 'NEES'
  plot 6 lc rgb '#888888' dt 2 title 'expected', \
       for [i=1:5] 'nees_'.word(modes, i).'.csv' skip 1 using 1:2 with linespoints lw 1.3 lc rgb colour[i] title word(modes, i) noenhanced
}
