# Estimates of one flight against the truth, with one published sigma. Called by make.sh with csv and out set.
set terminal svg size 900,720 dynamic background rgb 'white' font 'Helvetica,13'
set output out
set datafile separator ','
set multiplot layout 3,1 margins 0.1,0.97,0.08,0.95 spacing 0.06
set grid lc rgb '#e3e7ea'
set border lc rgb '#5b6770'
set xrange [0:30]
set format x ''
set key top right horizontal
est = '#1f6fb2'; tru = '#222222'; band = '#bcd7ee'
set ylabel 'HPC efficiency, %'
plot csv every 4 using 'time_s':(100*(column('hpc_efficiency_estimate')-column('hpc_efficiency_sigma'))):(100*(column('hpc_efficiency_estimate')+column('hpc_efficiency_sigma'))) with filledcurves lc rgb band title 'one published sigma', \
     '' every 4 using 'time_s':(100*column('hpc_efficiency_estimate')) with lines lw 1.5 lc rgb est title 'estimate', \
     '' every 4 using 'time_s':(100*column('hpc_efficiency_truth')) with lines lw 2 dt 2 lc rgb tru title 'truth'
unset key
set ylabel 'T40, K'
plot csv every 4 using 'time_s':(column('T40_estimate')-column('T40_sigma')):(column('T40_estimate')+column('T40_sigma')) with filledcurves lc rgb band, \
     '' every 4 using 'time_s':'T40_estimate' with lines lw 1.5 lc rgb est, '' every 4 using 'time_s':'T40_truth' with lines lw 2 dt 2 lc rgb tru
set format x '%g'
set xlabel 'time, s'
set ylabel 'net thrust, kN'
plot csv every 4 using 'time_s':((column('Fn_estimate')-column('Fn_sigma'))/1000):((column('Fn_estimate')+column('Fn_sigma'))/1000) with filledcurves lc rgb band, \
     '' every 4 using 'time_s':(column('Fn_estimate')/1000) with lines lw 1.5 lc rgb est, '' every 4 using 'time_s':(column('Fn_truth')/1000) with lines lw 2 dt 2 lc rgb tru
