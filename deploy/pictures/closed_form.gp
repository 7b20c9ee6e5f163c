# Error over the Bayes limit of every way to choose seven tuners, our engine at cruise. Called by make.sh with csv (of
# tuner_design baselines --csv), limit_h, limit_z and out set.
set terminal svg size 900,330 dynamic background rgb 'white' font 'Helvetica,13'
set output out
set datafile separator ','
set grid x lc rgb '#e3e7ea'
set border 3 lc rgb '#5b6770'
set tics nomirror
set logscale x
set xrange [0.9:60]
set yrange [-0.6:6.6]
set xlabel 'squared error over the fleet / Bayes limit'
set key right center
set lmargin 38
set arrow 1 from 1, graph 0 to 1, graph 1 nohead dt 2 lc rgb '#222222'
row(name) = name eq 'svd' ? 0 : name eq 'published_subset' ? 1 : name eq 'best_subset' ? 2 : name eq 'full_map' ? 3 : name eq 'closed_form' ? 4 : name eq 'design' ? 5 : name eq 'time_varying' ? 6 : NaN
set ytics ('SVD of [H; Hz]' 0, 'subset of health parameters, published' 1, 'best of all 120 subsets' 2, 'all ten, MAP on one snapshot' 3, 'closed form V = H Ph' 4, 'search from the closed form' 5, 'all ten, time-varying filter' 6)
plot csv using (column('ssee_health')/limit_h):(row(strcol('baseline'))+0.12) with points pt 7 ps 1.2 lc rgb '#1f6fb2' title 'health', \
     '' using (column('ssee_auxiliary')/limit_z):(row(strcol('baseline'))-0.12) with points pt 5 ps 1.1 lc rgb '#d1600a' title 'T40, T50, thrust, LPC margin'
