# How cost grows, as SVG, of what tools/performance.py wrote.
#
#   gnuplot -e "folder='results/performance'" tools/performance.gp

set encoding utf8
set datafile separator comma
set datafile columnheaders
set terminal svg size 900,560 font 'Helvetica,Arial,sans-serif,18' linewidth 1 background '#ffffff' dashlength 0.8
set linetype 1 linecolor '#000000' dashtype 1 linewidth 2.4 pointtype 4 pointsize 0.9
set linetype 2 linecolor '#d55e00' dashtype (12,5) linewidth 2.4 pointtype 6 pointsize 0.9
set linetype 3 linecolor '#0072b2' dashtype (3,4) linewidth 2.8 pointtype 8 pointsize 1.0
set linetype 4 linecolor '#009e73' dashtype (14,4,3,4) linewidth 2.4 pointtype 10 pointsize 1.0
set border 3 linewidth 1.2
set tics nomirror out scale 0.6
set grid linecolor '#d8d8d8' linetype 1 dashtype 1 linewidth 0.7
set key outside right center samplen 4 spacing 1.35
set lmargin 11
set title offset 0,0.3

medians = folder.'/medians.csv'
sets = 'portable SSE2 AVX2 AVX-512'
of(task, who, count, value) = strcol('task') eq task && strcol('who') eq who ? value : NaN

# --- samples: inverse, each instruction set -------------------------------------------------------------------------------

set output folder.'/figures/samples.svg'
set title 'Inverse dynamics, one thread: time of a pose in a batch'
set xlabel 'poses in the batch'
set ylabel 'ns a pose'
set logscale xy
set format x '10^{%T}'
set datafile missing NaN
plot for [k=1:words(sets)] medians \
  using (of('samples', 'inverse '.word(sets, k), 0, column('count'))):(1e9 * column('median_s')) \
  with linespoints linetype k title word(sets, k)

# --- threads -------------------------------------------------------------------------------------------------------------

set output folder.'/figures/threads.svg'
set title 'Batches of 100,000 poses: throughput'
set xlabel 'threads'
set ylabel 'million poses a second'
unset logscale
set format x '%g'
set xrange [0.8:2.2]
set xtics 1
set yrange [0:*]
plot for [task in 'inverse direct'] medians using (of('threads', task, 0, column('count'))):(1e-6 / column('median_s')) \
  with linespoints linetype (task eq 'inverse' ? 1 : 2) title task

# --- scenarios -----------------------------------------------------------------------------------------------------------

scenarios = folder.'/scenarios.csv'
if (system("test -e '".scenarios."' && echo yes") eq 'yes') {
  set output folder.'/figures/scenarios.svg'
  set title 'ursula validate, copies of the paper''s helix'
  set xlabel 'scenarios'
  set ylabel 'wall time (s)'
  set xrange [0:*]
  plot for [jobs=1:2] scenarios using (column('jobs') == jobs ? column('scenarios') : NaN):(column('wall_s')) \
    with linespoints linetype jobs title sprintf('%d job%s', jobs, jobs > 1 ? 's' : '')
}
