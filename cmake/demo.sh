#!/bin/sh
# `make demo`: the founding models, run and compared. Tables on the screen, plots and trajectories in out/.
set -eu
cd "$(dirname "$0")/.."
motus=build/motus
mkdir -p out

# Prints the command as a shell reads it, so that it can be copied: a word with other than plain characters is in quotes.
show() {
    echo
    printf '$ %s' "$motus"
    for word in "$@"; do
        case $word in
        *[!A-Za-z0-9_./,:=+-]*) printf ' "%s"' "$word" ;;
        *) printf ' %s' "$word" ;;
        esac
    done
    echo
    $motus "$@"
}

show compare models/projectile.motus
show compare models/spring.motus
show run models/projectile.motus       --plot out/projectile.svg --force
show run models/driven-oscillator.motus --plot out/driven-oscillator.svg -o out/driven-oscillator.csv --every "100 steps" --force
show run models/damped-cubic.motus     --plot out/damped-cubic.svg --force
show run models/damped-cubic.motus     --plot out/damped-cubic-phase.svg --plot-of "x,x'" --quiet --force
show compare models/driven-oscillator.motus
show compare models/damped-cubic.motus
show converge models/damped-cubic.motus --methods verlet,newmark,rk4,gauss6

echo
echo "Plots and trajectories are in $(pwd)/out:"
ls out | sed 's/^/    out\//'
