# Figures 7 to 14 of the paper as this program reproduces them, as SVG.
#
#   gnuplot -e "motion='inverse.csv'; poses='poses.csv'; folder='results/paper-helix/figures'; duration='3'" tools/figures.gp
#
# motion: `ursula inverse`; poses: `ursula poses`. Curves differ by dash and mark as well as by colour, for print.

set encoding utf8
set datafile separator comma
set datafile columnheaders
deg = 180 / pi
end = sprintf('t_f = %s s (not given in our source)', duration)

set terminal svg size 900,560 font 'Helvetica,Arial,sans-serif,18' linewidth 1 background '#ffffff' dashlength 0.8

# Colours that remain apart in grey and for colour-blind readers; every line has a dash and a mark of its own.
set linetype 1 linecolor '#000000' dashtype 1 linewidth 2.4 pointtype 4 pointsize 0.9
set linetype 2 linecolor '#d55e00' dashtype (12,5) linewidth 2.4 pointtype 6 pointsize 0.9
set linetype 3 linecolor '#0072b2' dashtype (3,4) linewidth 2.8 pointtype 8 pointsize 1.0
set linetype 4 linecolor '#009e73' dashtype (14,4,3,4) linewidth 2.4 pointtype 10 pointsize 1.0
set linetype 5 linecolor '#aa4499' dashtype (14,4,3,4,3,4) linewidth 2.4 pointtype 12 pointsize 1.0
set linetype 6 linecolor '#806000' dashtype (6,3) linewidth 1.6 pointtype 2 pointsize 0.9

set border 3 linewidth 1.2
set tics nomirror out scale 0.6
set grid linecolor '#d8d8d8' linetype 1 dashtype 1 linewidth 0.7
set xlabel 't (s)'
set key outside right center samplen 4 spacing 1.35
set lmargin 11
set title offset 0,0.3

# --- over time ---------------------------------------------------------------------------------------------------------

set output folder.'/fig-09-acceleration.svg'
set title 'Fig. 9: acceleration of P, '.end
set ylabel 'p̈ (m/s²)'
plot for [k=1:3] motion using 't_s':sprintf('a_%s_m_s2', word('x y z', k)) with linespoints linetype k \
  pointinterval -(28 + k) title word('x y z', k)

set output folder.'/fig-10-angular-acceleration.svg'
set title 'Fig. 10: angular acceleration of the platform, '.end
set ylabel 'ω̇ (rad/s²)'
plot for [k=1:3] motion using 't_s':sprintf('alpha_%s_rad_s2', word('x y z', k)) with linespoints linetype k \
  pointinterval -(28 + k) title word('x y z', k)

set output folder.'/fig-11-psi.svg'
set title 'Fig. 11: angles ψ at the universal joints, '.end
set ylabel 'ψ (rad)'
plot for [i=1:6] motion using 't_s':sprintf('psi_%d_rad', i) with linespoints linetype i pointinterval -(28 + i) \
  title sprintf('ψ_%d', i)

set output folder.'/fig-12-theta.svg'
set title 'Fig. 12: angles θ at the knees, '.end
set ylabel 'θ (deg)'
plot for [i=1:6] motion using 't_s':(column(sprintf('theta_%d_rad', i)) * deg) with linespoints linetype i \
  pointinterval -(28 + i) title sprintf('θ_%d', i)

set output folder.'/fig-13-phi.svg'
set title 'Fig. 13: angles φ of the motors, '.end
set ylabel 'φ (rad)'
plot for [i=1:6] motion using 't_s':sprintf('phi_%d_rad', i) with linespoints linetype i pointinterval -(28 + i) \
  title sprintf('φ_%d', i)

set output folder.'/fig-14-torques.svg'
set title 'Fig. 14: torques of the motors, '.end
set ylabel 'τ (kN·m)'
plot for [i=1:6] motion using 't_s':(column(sprintf('tau_%d_Nm', i)) / 1000) with linespoints linetype i \
  pointinterval -(28 + i) title sprintf('τ_%d', i)

# --- in space ----------------------------------------------------------------------------------------------------------

set terminal svg size 760,760 font 'Helvetica,Arial,sans-serif,18' linewidth 1 background '#ffffff' dashlength 0.8
unset lmargin
set border 4095 linecolor '#888888' linewidth 0.8
set tics scale 0.4 textcolor '#000000'
set xyplane 0
set view 68, 32
unset key

set output folder.'/fig-07-trajectory.svg'
set title 'Fig. 7: trajectory of P, '.end
set xlabel 'x (m)' offset 0,-0.5
set ylabel 'y (m)' offset 1.5,-0.5
set zlabel 'z (m)' rotate offset -1,0
set xrange [0:0.12]
set yrange [-0.21:-0.16]
set xtics 0.04 offset 0,-0.3
set ytics 0.02 offset 0.8,-0.2
set ztics 0.2
splot motion using 'p_x_m':'p_y_m':'p_z_m' with lines linetype 1, \
  motion using 'p_x_m':'p_y_m':'p_z_m' every 30 with points linetype 1 pointtype 7 pointsize 0.6

set terminal svg size 900,700 font 'Helvetica,Arial,sans-serif,18' linewidth 1 background '#ffffff' dashlength 0.8
set output folder.'/fig-08-poses.svg'
set title 'Fig. 8: poses along the helix, '.end
set border 31
set xrange [-2.1:2.1]
set yrange [-2.1:2.1]
set zrange [-0.25:1.75]
set view 72, 28, 1.45
set view equal xyz
set xtics 1 offset 0,-0.3
set ytics 1 offset 0.8,-0.2
set ztics 0.5
set key at screen 0.97, 0.88 right samplen 4
c(point, i, axis) = column(sprintf('%s_%d_%s_m', point, i, axis))
d(to, j, from, i, axis) = c(to, j, axis) - c(from, i, axis)
next(i) = i % 6 + 1
# One line of every leg i in row k: from point to point, as a vector without a head.
set style line 1 linecolor '#000000' dashtype 3 linewidth 2.2
set style line 2 linecolor '#0072b2' dashtype 2 linewidth 2.2
set style line 3 linecolor '#d55e00' dashtype 1 linewidth 2.6
set style line 4 linecolor '#9a9a9a' dashtype 3 linewidth 1.2
set style line 5 linecolor '#9a9a9a' dashtype 2 linewidth 1.2
set style line 6 linecolor '#707070' dashtype 1 linewidth 1.4
splot \
  for [i=1:6] poses using (c('A',i,'x')):(c('A',i,'y')):(c('A',i,'z')):(d('A',next(i),'A',i,'x')):(d('A',next(i),'A',i,'y')):(d('A',next(i),'A',i,'z')) \
    every ::0::0 with vectors nohead linecolor '#000000' dashtype 1 linewidth 1.2 notitle, \
  for [k=0:2] for [i=1:6] poses using (c('A',i,'x')):(c('A',i,'y')):(c('A',i,'z')):(d('R',i,'A',i,'x')):(d('R',i,'A',i,'y')):(d('R',i,'A',i,'z')) \
    every ::k::k with vectors nohead linestyle k+4 notitle, \
  for [k=0:2] for [i=1:6] poses using (c('R',i,'x')):(c('R',i,'y')):(c('R',i,'z')):(d('B',i,'R',i,'x')):(d('B',i,'R',i,'y')):(d('B',i,'R',i,'z')) \
    every ::k::k with vectors nohead linestyle k+4 notitle, \
  for [k=0:2] for [i=1:6] poses using (c('B',i,'x')):(c('B',i,'y')):(c('B',i,'z')):(d('B',next(i),'B',i,'x')):(d('B',next(i),'B',i,'y')):(d('B',next(i),'B',i,'z')) \
    every ::k::k with vectors nohead linestyle k+1 title (i == 1 ? word('start half-way end', k + 1) : ''), \
  motion using 'p_x_m':'p_y_m':'p_z_m' with lines linecolor '#000000' dashtype 1 linewidth 2 notitle, \
  poses using 'p_x_m':'p_y_m':'p_z_m' with points linecolor '#000000' pointtype 7 pointsize 0.7 title 'P'
set output
