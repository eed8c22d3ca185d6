# The figures 11 and 12 of the collaborative paper: estimated trajectories of all corridors; runs='corridor_1 …' is given.
set fit quiet logfile "/dev/null"
set datafile separator ','
set grid lc rgb '#dddddd'
blue = '#0060ad'; red = '#d1495b'; gray = '#404040'
errors(run, mode) = run.'/'.mode.'/errors.csv'

set terminal pngcairo size 1100,760 font 'sans,10'
set output 'corridor.png'
set multiplot layout 3,1 title 'Corridors of 15 m: trajectories from above, and errors'
set key outside right top
set xlabel 'x [m]'
set ylabel 'y [m]'
set yrange [-1.6:1.6]
do for [mode in 'mono collaborative'] {
  set title mode.(mode eq 'mono' ? ' (figure 11)' : ' (figure 12)')
  colour = mode eq 'mono' ? blue : red
  plot for [run in runs] errors(run, mode) skip 1 using 3:4 with lines lw 3 lc rgb gray notitle, \
       for [run in runs] errors(run, mode) skip 1 using 6:7 with lines lw 1 lc rgb colour notitle, \
       NaN with lines lw 3 lc rgb gray title 'truth', NaN with lines lw 1 lc rgb colour title 'estimated'
}
set title 'position error'
set xlabel 't [s]'
set ylabel 'error [m]'
set yrange [0:*]
plot for [run in runs] errors(run, 'mono') skip 1 using 2:9 with lines lw 1 lc rgb blue notitle, \
     for [run in runs] errors(run, 'collaborative') skip 1 using 2:9 with lines lw 1 lc rgb red notitle, \
     NaN with lines lw 2 lc rgb blue title 'mono', NaN with lines lw 2 lc rgb red title 'collaborative'
unset multiplot
