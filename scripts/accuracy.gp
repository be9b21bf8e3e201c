# The error of the sphere light's methods as SVG (`make plots`).
#
#   gnuplot -e 'table="accuracy.tsv"; folder="docs"' scripts/accuracy.gp
#
# `table` is what `accuracy --tsv` prints: roughness, radius, view, f0, method, whole, cut.
set datafile separator "\t"
set terminal svg size 900,360 font "sans-serif,12" background "white"
set logscale y
set yrange [0.005:2000]
set format y "%g %%"
set grid ytics lc rgb "#dddddd"
set border 3 lc rgb "#888888" back
set tics nomirror
set mytics 1
methods = "'closed form' LTC 'representative point'"
color(i) = word("#0060b0 #d07000 #808080", i)

# The lines of one method and radius, and of one `fixed` value in column `at`.
rows(i, radius, at, fixed) = sprintf("< awk -F '\t' '$5 == \"%s\" && $2 == %g && $%d == %g \
    && $4 == 1' '%s'", word(methods, i), radius, at, fixed, table)
shown(x) = x < 0.005 ? 0.005 : x # what is smaller stands on the axis

do for [plot = 1:2] {
    x = plot == 1 ? 1 : 3     # over roughness, over the eye's angle
    at = plot == 1 ? 3 : 1    # at this angle, at this roughness
    fixed = plot == 1 ? 60 : 0.35
    set output sprintf("%s/accuracy-%s.svg", folder, plot == 1 ? "roughness" : "view")
    set multiplot layout 1,3 margins 0.07,0.99,0.36,0.9 spacing 0.03
    set xlabel plot == 1 ? "roughness (eye at 60°)" : "angle of the eye (roughness .35)"
    set xrange [0:(plot == 1 ? 1 : 90)]
    step = plot == 1 ? 0.25 : 30
    set xtics step
    do for [panel = 1:3] {
        radius = real(word("0.05 0.2 0.9", panel))
        set title sprintf("R/d = %g", radius)
        set format y panel == 1 ? "%g %%" : ""
        if (panel == 2) { set key at screen 0.45,0.01 center bottom maxrows 3 } else { unset key }
        plot for [i = 1:3] rows(i, radius, at, fixed) using x:(shown(column(6))) \
                 with linespoints pt 7 ps 0.5 lw 2 lc rgb color(i) title word(methods, i), \
             for [i = 1:3] rows(i, radius, at, fixed) using x:(shown(column(7))) \
                 with linespoints pt 6 ps 0.5 lw 1 dt 2 lc rgb color(i) \
                 title word(methods, i) . ", lights cut by the horizon"
    }
    unset multiplot
}
