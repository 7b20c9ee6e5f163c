# A whole flight: estimates against the truth, with one published sigma. Called by make.sh with csv and out set.
set terminal svg size 900,860 dynamic background rgb 'white' font 'Helvetica,13'
set output out
set datafile separator ','
set multiplot layout 4,1 margins 0.1,0.97,0.07,0.96 spacing 0.045
set grid lc rgb '#e3e7ea'
set border lc rgb '#5b6770'
set xrange [0:30]
set format x ''
set key top right horizontal
est = '#1f6fb2'; tru = '#222222'; band = '#bcd7ee'
minutes(t) = t/60.0
set ylabel 'HPC efficiency, %'
set yrange [-5:3]
plot csv every 150 using (minutes(column('time_s'))):(100*(column('hpc_efficiency_estimate')-column('hpc_efficiency_sigma'))):(100*(column('hpc_efficiency_estimate')+column('hpc_efficiency_sigma'))) with filledcurves lc rgb band title 'one published sigma', \
     '' every 150 using (minutes(column('time_s'))):(100*column('hpc_efficiency_estimate')) with lines lw 1.5 lc rgb est title 'estimate', \
     '' every 150 using (minutes(column('time_s'))):(100*column('hpc_efficiency_truth')) with lines lw 2 dt 2 lc rgb tru title 'truth'
unset key
set autoscale y
set ylabel 'T40, K'
plot csv every 150 using (minutes(column('time_s'))):(column('T40_estimate')-column('T40_sigma')):(column('T40_estimate')+column('T40_sigma')) with filledcurves lc rgb band, \
     '' every 150 using (minutes(column('time_s'))):'T40_estimate' with lines lw 1.5 lc rgb est, '' every 150 using (minutes(column('time_s'))):'T40_truth' with lines lw 2 dt 2 lc rgb tru
err(name) = column(name.'_estimate')-column(name.'_truth')
set ylabel 'T40 error, K'
set yrange [-15:15]
plot csv every 150 using (minutes(column('time_s'))):(-column('T40_sigma')):(column('T40_sigma')) with filledcurves lc rgb band, \
     '' every 150 using (minutes(column('time_s'))):(err('T40')) with lines lw 1.5 lc rgb est, 0 with lines lw 1 dt 2 lc rgb tru
set format x '%g'
set xlabel 'minutes of the compressed flight'
set ylabel 'thrust error, kN'
set yrange [-4:4]
plot csv every 150 using (minutes(column('time_s'))):(-column('Fn_sigma')/1000):(column('Fn_sigma')/1000) with filledcurves lc rgb band, \
     '' every 150 using (minutes(column('time_s'))):(err('Fn')/1000) with lines lw 1.5 lc rgb est, 0 with lines lw 1 dt 2 lc rgb tru
