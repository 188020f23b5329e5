# From the element stresses of a CalculiX .dat file, the mean von Mises stress of each element, in their order:
#   awk -f mises.awk bracket.dat > stress.csv
NF == 8 && $1 ~ /^[0-9]+$/ {
    pressure = ($3 + $4 + $5) / 3
    shear = $6 * $6 + $7 * $7 + $8 * $8
    sum[$1] += sqrt(1.5 * (($3 - pressure) ^ 2 + ($4 - pressure) ^ 2 + ($5 - pressure) ^ 2 + 2 * shear))
    points[$1]++
    if ($1 > last) last = $1
}
END { for (element = 1; element <= last; element++) printf "%.6g\n", sum[element] / points[element] }
