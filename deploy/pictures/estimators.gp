# One demo flight by the three linear estimators of a point: how each takes up a step of health, with one published sigma.
# Called by make.sh with folder (FOLDER/NAME.csv of each) and out set.
set terminal svg size 900,700 dynamic background rgb 'white' font 'Helvetica,13'
set output out
set datafile separator ','
set multiplot layout 3,1 margins 0.1,0.97,0.08,0.95 spacing 0.06
set grid lc rgb '#e3e7ea'
set border lc rgb '#5b6770'
set yrange [-4.5:2.5]
set format x ''
est = '#1f6fb2'; tru = '#222222'; band = '#bcd7ee'
do for [k=1:3] {
  name = word('tuner gauss_markov time_varying', k)
  csv = folder.'/'.name.'.csv'
  if (k == 1) { set key top right horizontal } else { unset key }
  if (k == 3) { set format x '%g'; set xlabel 'seconds' }
  set ylabel 'HPC efficiency, %'
  set title sprintf('estimator %s', name) offset 0,-0.7 noenhanced
  plot csv every 4 using (column('time_s')):(100*(column('hpc_efficiency_estimate')-column('hpc_efficiency_sigma'))):(100*(column('hpc_efficiency_estimate')+column('hpc_efficiency_sigma'))) with filledcurves lc rgb band title 'one published sigma', \
       '' every 4 using (column('time_s')):(100*column('hpc_efficiency_estimate')) with lines lw 1.5 lc rgb est title 'estimate', \
       '' every 4 using (column('time_s')):(100*column('hpc_efficiency_truth')) with lines lw 2 dt 2 lc rgb tru title 'truth'
}
