# The figures 7 to 10 of the collaborative paper from this folder's csv files.
set fit quiet logfile "/dev/null"
set datafile separator ','
set grid lc rgb '#dddddd'
blue = '#0060ad'; red = '#d1495b'; gray = '#404040'

set terminal pngcairo size 1000,560 font 'sans,10'
set output 'figure7.png'
set multiplot layout 2,1 title 'Figure 7: map and trajectory of the run with the median error of mono'
set key outside right top
set xlabel 'x [m]'
set ylabel 'z [m]'
do for [mode in 'mono collaborative'] {
  set title mode
  colour = mode eq 'mono' ? blue : red
  plot 'map_'.mode.'.csv' skip 1 using 1:2 with points pt 6 ps 0.9 lc rgb gray title 'true landmarks', \
       '' skip 1 using 3:4 with points pt 2 ps 0.7 lc rgb colour title 'estimated', \
       'run_'.mode.'.csv' skip 1 using 2:3 with lines lw 3 lc rgb gray title 'true path', \
       '' skip 1 using 4:5 with lines lw 2 lc rgb colour title 'estimated path'
}
unset multiplot

set output 'figure8.png'
set terminal pngcairo size 1000,420 font 'sans,10'
set multiplot layout 1,2 title 'Figure 8: mean absolute error over all runs (shaded: pseudo-stereo)'
set object 1 rectangle from 8, graph 0 to 9, graph 1 fc rgb '#f3e3b3' fs solid 0.7 noborder behind
set object 2 rectangle from 17, graph 0 to 19, graph 1 fc rgb '#f3e3b3' fs solid 0.7 noborder behind
set key inside left top
set xlabel 't [s]'
set xrange [0:30]
set yrange [0:*]
set title 'scale (C14)'
set ylabel '|1 - mean(d / d_{est})|'
plot 'errors.csv' skip 1 using 1:2 with lines lw 2 lc rgb blue title 'mono', \
     '' skip 1 using 1:3 with lines lw 2 lc rgb red title 'collaborative'
set title 'camera position'
set ylabel 'error [m]'
plot 'errors.csv' skip 1 using 1:4 with lines lw 2 lc rgb blue title 'mono', \
     '' skip 1 using 1:5 with lines lw 2 lc rgb red title 'collaborative'
unset multiplot

set output 'figure9.png'
set terminal pngcairo size 700,420 font 'sans,10'
set title 'Figure 9: position error for several range noises'
set palette defined (0.25 '#2a9d4a', 0.6 '#e08e0b', 1.0 '#d1495b')
set cbrange [0.25:1]
set cblabel 'σ_r [m]'
plot 'errors.csv' skip 1 using 1:4 with lines lw 2 dt 2 lc rgb blue title 'mono', \
     for [s in '0.25 0.375 0.5 0.625 0.75 0.875 1'] 'sweep.csv' skip 1 \
       using ($1 == real(s) ? $2 : NaN):3:1 with lines lw 2 lc palette notitle
unset colorbox
unset object 1
unset object 2

set output 'figure10.png'
set terminal pngcairo size 560,420 font 'sans,10'
set title 'Figure 10: error over the whole path against range noise'
set xrange [0.2:1.05]
set autoscale y
set xlabel 'σ_r [m]'
set ylabel 'mean position error [m]'
f(x) = a * x + b
fit f(x) 'correlation.csv' skip 1 using 1:2 via a, b
stats 'correlation.csv' skip 1 using 1:2 name 'C' nooutput
set label 1 sprintf('correlation %.2f', C_correlation) at graph 0.05, 0.92
plot 'correlation.csv' skip 1 using 1:2 with points pt 7 ps 1.3 lc rgb red notitle, f(x) with lines lc rgb gray notitle
