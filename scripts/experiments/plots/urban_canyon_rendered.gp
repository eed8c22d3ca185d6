# Trajectories of the rendered canyons, each piece laid onto the truth at its first pose; canyons='…', seed='…' and modes='…' are given.
set datafile separator ','
set grid lc rgb '#dddddd'
array colour[5] = ['#404040', '#e08e0b', '#2a9d4a', '#0060ad', '#d1495b']
pieces(canyon, mode) = system('ls -d '.canyon.'/'.seed.'/'.mode.'/piece_*/errors.csv 2>/dev/null | tr "\n" " "')

set terminal pngcairo size 1100,480 * words(canyons) font 'sans,10'
set output 'trajectories.png'
set multiplot layout words(canyons),2
set key outside right top noenhanced
do for [canyon in canyons] {
  set title canyon noenhanced
  set size ratio -1
  # As far as the truth goes: a mode that has lost its scale leaves the picture.
  stats '<cat '.pieces(canyon, word(modes, 1)).' | grep -v stamp' using 3:4 nooutput
  set xrange [STATS_min_x - 60:STATS_max_x + 60]
  set yrange [STATS_min_y - 60:STATS_max_y + 60]
  set xlabel 'x [m]'
  set ylabel 'y [m]'
  plot for [file in pieces(canyon, word(modes, 1))] file skip 1 using 3:4 with lines lw 4 lc rgb '#bbbbbb' notitle, \
       NaN with lines lw 4 lc rgb '#bbbbbb' title 'truth', \
       for [i=1:words(modes)] for [file in pieces(canyon, word(modes, i))] file skip 1 using 6:7 with lines lw 1.5 lc rgb colour[i] notitle, \
       for [i=1:words(modes)] NaN with lines lw 1.5 lc rgb colour[i] title word(modes, i)
  set size noratio
  set xrange [0:*]
  set yrange [0.1:*]
  set logscale y
  set xlabel 't [s]'
  set ylabel 'position error since the start [m]'
  set title 'position error'
  plot for [i=1:words(modes)] for [file in pieces(canyon, word(modes, i))] file skip 1 using 2:9 with lines lw 1.5 lc rgb colour[i] notitle
  unset logscale y
}
unset multiplot
