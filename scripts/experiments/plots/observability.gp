# Singular values of the paper's system at random states; what is zero is drawn at the floor.
set terminal pngcairo size 900,420 font 'sans,10'
set output 'observability.png'
set datafile separator ','
set logscale y
set yrange [1e-6:5]
set format y '10^{%T}'
set xrange [0.5:10.5]
set xtics 1
set grid ytics lc rgb '#dddddd'
set xlabel 'index'
shown(v) = v < 2e-6 ? 2e-6 : v
of(d, column) = $1 == d && $2 == 1 && $3 == 0 && $4 == 0 ? shown(column) : NaN
set multiplot layout 1,3 title 'Observability matrix: singular values at random states (at the floor: zero)'
set ylabel 'singular value, rows normalised'
do for [d = 0:2] {
  set title (d == 0 ? 'no pseudo-stereo depth: rank 8' : d == 1 ? 'one: rank 9' : 'two: rank 10')
  plot 'singular_values.csv' skip 1 using ($5 + 0.5 * (rand(0) - 0.5)):(of(d, $6)) with points pt 7 ps 0.3 lc rgb '#0060ad' notitle
  unset ylabel
}
unset multiplot
