# Average NEES and NIS over time from this folder's csv files; shaded: the 95 % band of 50 runs, and the wearer's glances.
set datafile separator ','
set grid lc rgb '#dddddd'
set terminal pngcairo size 1100,760 font 'sans,10'
blue = '#0060ad'; red = '#d1495b'; gray = '#404040'; green = '#2a9d4a'

glances = 'set object 11 rectangle from 0.1, graph 0 to 2, graph 1 fc rgb "#f3e3b3" fs solid 0.6 noborder behind; set object 12 rectangle from 5.1, graph 0 to 7, graph 1 fc rgb "#f3e3b3" fs solid 0.6 noborder behind'

set output 'consistency.png'
set multiplot layout 3,3 title 'Average pose NEES of 50 runs (6 expected; lines: its 95 % band [5.08, 7.00]; shaded: the wearer looks)'
set xrange [0:10]
set yrange [0:20]
set xlabel 't [s]'
eval glances
# Mono has a first glance of half a second, for its scale; `always` has nothing else.
do for [mode in 'collaborative mono always room independent_updates independent_starts points paper overconfident'] {
  set title mode noenhanced
  if (mode eq 'mono' || mode eq 'always') { unset object 11; unset object 12 } else { eval glances }
  plot 'nees_'.mode.'.csv' skip 1 using 1:2 with lines lw 2 lc rgb blue title 'pose', \
       '' skip 1 using 1:3 with lines lw 1.5 lc rgb green title 'position (3 expected)', \
       5.08 with lines dt 2 lc rgb gray notitle, 7.00 with lines dt 2 lc rgb gray notitle
}
unset multiplot

eval glances
set output 'innovations.png'
set terminal pngcairo size 1100,380 font 'sans,10'
set multiplot layout 1,3 title 'Normalised innovations squared a row (1 expected)'
set yrange [0.5:2]
do for [mode in 'collaborative points paper'] {
  set title mode noenhanced
  plot 'nees_'.mode.'.csv' skip 1 using 1:4 with lines lw 1.5 lc rgb blue title 'pixels of Cs', \
       '' skip 1 using 1:($5 > 0 ? $5 : NaN) with lines lw 1.5 lc rgb red title 'by the wearer', \
       '' skip 1 using 1:6 with lines lw 1.5 lc rgb gray title 'all together'
}
unset multiplot

set output 'rig_error.png'
set terminal pngcairo size 1100,560 font 'sans,10'
set multiplot layout 2,3 title 'Pose of Cf known with 5 cm and 2°: average pose NEES of 50 runs (6 expected; lines: its 95 % band)'
set yrange [0:50]
do for [error in 'wide wide_3s'] {
  do for [treatment in 'points pixels state_iterated'] {
    set title (error eq 'wide' ? 'new in every frame, ' : 'wanders within 3 s, ').treatment noenhanced
    plot 'nees_'.error.'_'.treatment.'.csv' skip 1 using 1:2 with lines lw 2 lc rgb blue title 'pose', \
         '' skip 1 using 1:3 with lines lw 1.5 lc rgb green title 'position (3 expected)', \
         5.08 with lines dt 2 lc rgb gray notitle, 7.00 with lines dt 2 lc rgb gray notitle
  }
}
unset multiplot

set output 'association.png'
set terminal pngcairo size 1100,380 font 'sans,10'
set multiplot layout 1,2 title '30 % wrong matches, gates and joint compatibility on, 50 runs'
set title 'average NEES'
set yrange [0:20]
plot 'nees_real_association.csv' skip 1 using 1:2 with lines lw 2 lc rgb blue title 'pose (6 expected)', \
     '' skip 1 using 1:3 with lines lw 1.5 lc rgb green title 'position (3 expected)', \
     5.08 with lines dt 2 lc rgb gray notitle, 7.00 with lines dt 2 lc rgb gray notitle
set title 'normalised innovations squared a row (gated: under 1)'
set yrange [0.5:1.5]
plot 'nees_real_association.csv' skip 1 using 1:4 with lines lw 1.5 lc rgb blue title 'pixels of Cs', \
     '' skip 1 using 1:($5 > 0 ? $5 : NaN) with lines lw 1.5 lc rgb red title 'by the wearer', \
     '' skip 1 using 1:6 with lines lw 1.5 lc rgb gray title 'all together'
unset multiplot
