# The picture in docs/images, from the rows of work_precision:
#   mooring_precision > rows.txt && gnuplot -e "rows='rows.txt'; picture='mooring_precision.png'" plot.gp
set terminal pngcairo size 1100,480 font "DejaVu Sans,11"
set output picture
set multiplot layout 1,2
set logscale xy
set grid xtics ytics lc rgb "#dddddd"
set xlabel "microseconds per simulated second"
set ylabel "rms error, % of the first harmonic"
set format y "%g"
set key top right
set xrange [1e3:3e6]
set yrange [2e-5:100]
above(step) = step == 0.01 || step == 0.0001 ? sprintf("%g ms", step*1000) : ""
below(step) = step == 0.001 ? "1 ms" : ""
do for [study in "shaken snapping"] {
    set title study eq "shaken" ? "Steel wire, shaken" : "Steel wire that snaps every second"
    plot "< grep '^".study." implicit' ".rows using 4:5 with linespoints pt 7 lw 2 lc rgb "#1f6fb4" title "implicit (BDF2), steps of 10 to 0.1 ms", \
         "< grep '^".study." implicit' ".rows using 4:5:(above($3)) with labels center offset 0,1 font ",8" tc rgb "#1f6fb4" notitle, \
         "< grep '^".study." implicit' ".rows using 4:5:(below($3)) with labels center offset 0,-1 font ",8" tc rgb "#1f6fb4" notitle, \
         "< grep '^".study." explicit' ".rows using 4:5 with linespoints pt 5 lw 2 lc rgb "#c0392b" title "explicit (RK2), 1 and 1/2 of its limit", \
         3 with lines dt 2 lc rgb "#888888" title "3 %"
}
