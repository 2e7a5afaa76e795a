#!/bin/bash
# motus lab and --share: the fragment of a link, and the page with a model in it, written and opened. The page is a small one made here;
# test/page.sh tests the real one.
#
# Each case is one line `ok` or `not ok`; the last line counts them. MOTUS is the program (build/motus).
cd "$(dirname "$0")/.." || exit 1
. test/cli/cases.sh
cd "$place" || exit 1
unset BROWSER

cat >osc.motus <<'M'
F = 0.1
x'' = -x + F cos(t)
x(0) = 0
x'(0) = 0
method verlet
step 0.01
until 2
M
cat >page.html <<'P'
<!doctype html>
<html lang="en"><head><meta charset="utf-8">
<meta name="motus-start" content="">
<title>motus &amp; more</title></head>
<body><script>document.querySelector('meta[name="motus-start"]').content</script></body></html>
P
export MOTUS_LAB_PAGE=$place/page.html
is() { [ "$1" = "$2" ] || { printf '%s\nis not\n%s\n' "$1" "$2"; return 1; }; }
# Reads the fragment: its keys in order, and the decoded values of one of them.
keys() { head -n 1 "${1:-$out}" | tr '#&' '\n\n' | sed 1d | cut -d= -f1 | tr '\n' ' '; }
value() { head -n 1 "${2:-$out}" | tr '#&' '\n\n' | grep "^$1=" | cut -d= -f2- | while read -r text; do printf '%b' "${text//%/\\x}"; done; }
share() { "$motus" run "$@" --share >"$out" 2>"$err" </dev/null; }

# --- the fragment -------------------------------------------------------------------------------------------------------------------
gives "run --share" 0 "$motus" run osc.motus --share
that "... prints nothing else" eval "empty '$err' && [ \$(wc -l <'$out') = 1 ]"
that "... the model and no more: what it says itself is not repeated" is "$(keys)" "v m "
that "... version 1" is "$(value v)" 1
value m >decoded
that "... the text as it is, to the byte" cmp osc.motus decoded
gives "everything" 0 "$motus" run osc.motus --until "2 pi" --set F=0.2 --step 1/64 --method "newmark(1/4, 1/2)" --set "x'(0)=1" --share
that "... in the order v m s a h T, --set in its own" is "$(keys)" "v m s s a h T "
that "... written so" eval "head -n 1 '$out' | grep -qF '&s=F%3D0.2&s=x%27(0)%3D1&a=newmark(1%2F4,%201%2F2)&h=1%2F64&T=2%20pi'"
gives "... --json" 0 "$motus" run osc.motus --set F=0.2 --share --json
that "... the same text" is "$(jq -r .share "$out")" "$("$motus" run osc.motus --set F=0.2 --share)"
that "... and no other key" holds 'keys == ["share"]'
for typed in .5 1.; do
    share osc.motus --step "$typed" --until 9
    that "--step $typed, which the language does not write so, is there in digits" is "$(value h)" "$(awk -v s="$typed" 'BEGIN { print s + 0 }')"
done
for typed in 0.010 1e-2 +2 pi/100 "2 pi" "2*pi/ 3"; do
    share osc.motus --step "$typed" --until 9
    that "--step $typed is there as it was typed" is "$(value h)" "$typed"
done
share osc.motus --until -1
that "--until -1" is "$(value T)" -1
share osc.motus --method dop853 --tolerance 1e-6 --until 9
that "a tolerance, between methods and end" is "$(keys):$(value r)" "v m a r T :1e-06"
share osc.motus --accuracy 1e-6 --until 9
that "an accuracy, in its place" is "$(keys):$(value g)" "v m g T :1e-06"
refuses "an absolute accuracy, in a link" 2 "a link has a relative accuracy" "$motus" run osc.motus --accuracy "1e-6 absolute" --share
refuses "an absolute tolerance, in a link" 2 "a link has a relative tolerance" "$motus" run osc.motus --method dop853 --tolerance "1e-6 absolute" --share
gives "compare --share" 0 "$motus" compare osc.motus --methods "rk4, newmark(1/4, 1/2),verlet" --step 0.1 --share
that "... the methods" is "$(keys):$(value a)" "v m a h :rk4,newmark(1/4, 1/2),verlet"
"$motus" run - --share <osc.motus >"$out" 2>"$err"
value m >decoded
that "a model from standard input" cmp osc.motus decoded

# Comments may hold every character; the fragment must consist of its alphabet alone.
nasty=$'# "q" \'a\' `b` \\ \\n \\x41 %41 %% + & &amp; &#39; = ? # / : ; @ $(touch owned) </script><script>alert(1)</script> --> <!-- ]]> {} [] | ^ ~ *\n# \001\002\037\177\033[31m\t\r\n# grün θ₁ 日本 🜲 \u2028 \u202e \ufeff \ufffd\n'
printf '%s' "$nasty" >nasty.motus
cat osc.motus >>nasty.motus
share nasty.motus --set $'F=0.2 # "\' </script> & \\ \001 θ'
value m >decoded
that "a nasty text comes back to the byte" cmp nasty.motus decoded
value s >decoded
that "... a nasty --set too" is "$(cat decoded)" $'F=0.2 # "\' </script> & \\ \001 θ'
that "... and is made of harmless characters" eval "! head -n 1 '$out' | LC_ALL=C grep -q '[^A-Za-z0-9._~(),*%=&#-]' && is \"\$(tr -cd '#' <'$out')\" '#'"
that "... every % with two digits in upper case" eval "! sed 's/%[0-9A-F][0-9A-F]//g' '$out' | grep -q %"
cp "$out" nasty.fragment
printf "# \xe9t\xe9\n" | cat - osc.motus >latin.motus
refuses "a text that is not UTF-8" 2 "latin.motus:1:3: this byte is not UTF-8" "$motus" run latin.motus --share
refuses "... in --set" 2 "not UTF-8" "$motus" run osc.motus --set $'F=1 # \xff' --share
# the bound holds to the byte
room=$((65536 - $(stat -c %s osc.motus) - $(printf '%s' F=0.2 | wc -c) - 1 - 2))
{ cat osc.motus; printf '# %*s\n' $((room)) "" | tr ' ' '#'; } >full.motus
truncate -s $((65536 - 6)) full.motus && sed -i '$ s/.$/\n/' full.motus
share full.motus --set F=0.2
that "a text as long as may be" is "$(($(value m | wc -c) + $(value s | wc -c) + $(value v | wc -c)))" 65536
refuses "... and one byte more" 2 "longer than 65536 bytes" "$motus" run full.motus --set F=0.25 --share

# Wrong requests give the usual errors, and nothing is printed.
printf "x'' = -omga x\nx(0)=1\nx'(0)=0\nstep 0.1\nuntil 1\n" >slip.motus
refuses "--share of a model with a mistake" 2 "slip.motus:1:8: " "$motus" run slip.motus --share
printf "x'' = -x\nx(0)=1\nx'(0)=0\nuntil 1\n" >nostep.motus
for verb in run compare; do gives "$verb --share without a step anywhere" 0 "$motus" $verb nostep.motus --share; done
gives "... which the command line may give too" 0 "$motus" run nostep.motus --step 0.1 --share
refuses "--share with an unknown method" 2 "verlett" "$motus" run osc.motus --method verlett --share
refuses "... of compare" 2 "verlett" "$motus" compare osc.motus --methods rk4,verlett --share
refuses "--share with a method that does not fit" 2 "pefrl" "$motus" run "$root/models/damped-cubic.motus" --method pefrl --share
refuses "--share without a model" 2 "needs a model" "$motus" run --share
for other in "-o traj.csv" "--plot fig.svg" "--save-state state" "--restart state" "--emit-c"; do
    # shellcheck disable=SC2086
    refuses "--share and ${other%% *}" 2 "exclude each other" "$motus" run osc.motus --share $other
done
refuses "--share and --evaluations" 2 "exclude each other" "$motus" compare osc.motus --share --evaluations 100
refuses "--share of another verb" 2 "--share belongs to: run, compare" "$motus" converge osc.motus --share
that "... no file came of it" absent traj.csv
"$motus" run osc.motus --share >/dev/full 2>"$err"
that "a full standard output" eval "[ $? = 1 ] && says 'standard output' '$err'"

# --- the page -------------------------------------------------------------------------------------------------------------------------
# The written page is the built one except for the one place.
holds_fragment() { # page, fragment with its #
    local start=${2#\#}
    start=${start//&/&amp;}
    is "$(cat "$1")" "$(awk -v start="$start" 'BEGIN { gsub(/&/, "\\\\&", start) } { sub(/name="motus-start" content=""/, "name=\"motus-start\" content=\"" start "\""); print }' page.html)"
}
gives "lab --no-open" 0 "$motus" lab osc.motus --no-open
that "... prints the path" is "$(cat "$out")" osc-lab.html
that "... the page with the model" holds_fragment osc-lab.html "$("$motus" run osc.motus --share)"
gives "lab with settings" 0 "$motus" lab osc.motus --no-open -o given.html --set F=0.2 --method verlet --methods "rk4,verlet,newmark(1/4, 1/2)" --step 1/64 --until 3
that "... has them, the main method first and once" eval "grep -qF '&amp;s=F%3D0.2&amp;a=verlet,rk4,newmark(1%2F4,%201%2F2)&amp;h=1%2F64&amp;T=3\">' given.html"
gives "lab without a model" 0 "$motus" lab --no-open --json
that "... says where" holds '. == {output: "motus-lab.html"}'
that "... is the page as it was built" cmp page.html motus-lab.html
gives "a nasty model" 0 "$motus" lab nasty.motus --no-open -q --set $'F=0.2 # "\' </script> & \\ \001 θ'
that "... is quiet" eval "empty '$out' && empty '$err'"
that "... stays in its quotes" holds_fragment nasty-lab.html "$(cat nasty.fragment)"
that "... and opens or closes nothing" is "$(tr -cd '<>\"'"'" <nasty-lab.html)" "$(tr -cd '<>\"'"'" <page.html)"
"$motus" lab - --no-open <osc.motus >"$out" 2>"$err"
that "a model from standard input" eval "is \"\$(cat '$out')\" model-lab.html && cmp model-lab.html osc-lab.html"
long=$(printf 'é%.0s' $(seq 100))
cp osc.motus "$long.motus"
gives "a long name" 0 "$motus" lab "$long.motus" --no-open
that "... is cut at a whole letter" cmp "${long:0:31}-lab.html" osc-lab.html
cp osc.motus $'we\nird \033[31m.motus'
gives "a name with a newline and an escape" 0 "$motus" lab $'we\nird \033[31m.motus' --no-open
that "... gives a file without them" is "$(cat "$out")" $'we\ufffdird \ufffd[31m-lab.html'
gives "-o -" 0 "$motus" lab osc.motus -o -
that "... is the page alone" cmp "$out" osc-lab.html
gives "-o - and --json" 2 "$motus" lab osc.motus -o - --json
that "... is refused" holds '.error.message | contains("--json and -o -")'
gives "a model without step and end, which the page may choose" 0 "$motus" lab <(printf "x'' = -x\nx(0)=1\nx'(0)=0\n") --no-open -o bare.html

mkdir empty && cd empty || exit 1
refuses "lab of a model with a mistake" 2 "slip.motus:1:8: " "$motus" lab ../slip.motus
refuses "lab with an unknown method" 2 "verlett" "$motus" lab ../osc.motus --methods rk4,verlett
refuses "lab with a method that does not fit" 2 "pefrl" "$motus" lab "$root/models/damped-cubic.motus" --method pefrl
refuses "lab of a text that is not UTF-8" 2 "latin.motus:1:3: " "$motus" lab ../latin.motus
refuses "lab of a long model" 2 "longer than 65536 bytes" "$motus" lab "../full.motus" --set F=0.25
for option in --set=F=1 --method=rk4 --methods=rk4 --step=0.1 --until=1; do
    refuses "${option%%=*} without a model" 2 "${option%%=*} needs a model" "$motus" lab "$option"
done
refuses "--no-open elsewhere" 2 "motus run takes no --no-open" "$motus" run ../osc.motus --no-open
refuses "a model that is not there" 1 "cannot read" "$motus" lab nowhere.motus
that "nothing was written" eval "[ -z \"\$(ls -A)\" ]"
cd .. || exit 1

# --- files: whole or not at all ---------------------------------------------------------------------------------------------------------
refuses "a folder that is not there" 1 "cannot write nowhere/lab.html" "$motus" lab osc.motus -o nowhere/lab.html
refuses "a folder as output" 1 "cannot write" "$motus" lab osc.motus -o empty
refuses "a full disk" 1 "No space left" "$motus" lab osc.motus -o /dev/full
cp osc.motus self.html
refuses "the model as its own page" 2 "would be overwritten" "$motus" lab self.html -o self.html
refuses "the page as its own copy" 2 "would be overwritten" "$motus" lab osc.motus -o page.html
ln -s page.html link.html
refuses "... through a link" 2 "would be overwritten" "$motus" lab osc.motus -o link.html
echo precious >kept.html
"$motus" lab osc.motus --no-open -o kept.html --force >/dev/full 2>"$err"
that "a full standard output" eval "[ $? = 1 ] && says 'standard output' '$err'"
that "... leaves the old page as it was" is "$(cat kept.html)" precious
"$motus" lab osc.motus --no-open -o open.html >"$out"
"$motus" lab osc.motus --no-open -o closed.html <&- >&- 2>&-
that "descriptors 0 to 2 closed: the page has its bytes" eval "[ $? = 0 ] && cmp open.html closed.html"
mkdir small
if mount -t tmpfs -o size=64k none small 2>/dev/null; then
    { cat page.html; head -c 100000 /dev/zero | tr '\0' ' '; } >large.html
    refuses "a full file system" 1 "No space left" env MOTUS_LAB_PAGE=large.html "$motus" lab osc.motus -o small/lab.html
    that "... is left as it was" eval "[ -z \"\$(ls -A small)\" ]"
    umount small
fi
if [ "$(id -u)" != 0 ]; then
    mkdir locked && chmod 555 locked
    refuses "a folder that takes no files" 1 "Permission denied" "$motus" lab osc.motus -o locked/lab.html
fi
that "no temporary files are left" nothing_left .

# --- where the page is ------------------------------------------------------------------------------------------------------------------
page() { MOTUS_LAB_PAGE=$1 "$motus" lab osc.motus -o never.html; }
refuses "a page that is not there" 1 "cannot read nowhere.html" page nowhere.html
sed 's/<meta name="motus-start" content="">//' page.html >none.html
refuses "a page without a place for the start" 1 "none.html is not the page of the lab" page none.html
sed '/motus-start/p' page.html >two.html
refuses "a page with two" 1 "two.html is not the page of the lab" page two.html
refuses "a page that was written already" 1 "its motus-start is not empty" page osc-lab.html
head -c 85 page.html >torn.html
refuses "a page torn in that place" 1 "torn.html is not the page of the lab" page torn.html
{ cat page.html; printf '\0'; } >zero.html
refuses "a page with a byte 0" 1 "byte 0" page zero.html
refuses "a folder as page" 1 "folder" page empty
MOTUS_LAB_PAGE=none.html "$motus" lab osc.motus --json >"$out" 2>"$err"
that "... as JSON, of the kind file" holds '.error.kind == "file" and (.error.message | contains("make lab"))'
that "... nothing was written" absent never.html
# In the build tree, and installed.
mkdir -p tree/lab prefix/bin prefix/share/motus
cp "$motus" tree/motus && cp "$motus" prefix/bin/motus
for program in tree/motus prefix/bin/motus; do
    refuses "$program: no page anywhere" 1 "the page of the lab is missing" env MOTUS_LAB_PAGE= "$program" lab osc.motus
    that "... says what makes it" says "make lab builds it" "$err"
done
cp page.html tree/lab/motus-lab.html
gives "the page beside the program" 0 env MOTUS_LAB_PAGE= tree/motus lab --no-open -o tree.html
that "... is taken" cmp page.html tree.html
cp page.html prefix/share/motus/motus-lab.html
gives "the installed page" 0 env -u MOTUS_LAB_PAGE PATH="$place/prefix/bin:$PATH" motus lab --no-open -o prefix.html
that "... is taken" cmp page.html prefix.html

# --- the browser --------------------------------------------------------------------------------------------------------------------------
# A browser that records its arguments, input and output, and stays.
mkdir "bin" "a browser"
cat >"a browser/rec" <<'B'
#!/bin/bash
printf '%s\n' "$#" "$@" >"$RECORD.new"
readlink /proc/$$/fd/0 /proc/$$/fd/1 /proc/$$/fd/2 >>"$RECORD.new"
echo shown; echo shown >&2
echo $$ >>"$RECORD.pids"
mv "$RECORD.new" "$RECORD"
exec sleep 100
B
chmod +x "a browser/rec"
export RECORD=$place/record
# Of those the test ends: all.
trap 'kill $(cat "$RECORD.pids") 2>/dev/null; rm -rf "$place"' EXIT
# Its record, when it is written; the address alone.
notes() { for _ in $(seq 200); do [ -e "$RECORD" ] && break; sleep 0.02; done; tr '\n' ' ' <"$RECORD"; rm -f "$RECORD"; }
recorded() { notes | cut -d' ' -f2; }
gives "a browser is started" 0 env BROWSER="$place/a browser/rec" "$motus" lab osc.motus
that "... the path is printed and nothing of the browser's" eval "is \"\$(cat '$out')\" osc-lab.html && empty '$err'"
that "... it has one argument, the address of the file, and no input or output" is "$(notes)" "1 file://$place/osc-lab.html /dev/null /dev/null /dev/null "
that "... and it is not waited for" kill -0 "$(head -n 1 "$RECORD.pids")"
gives "a path with blanks, a leading dash and more" 0 env BROWSER="$place/a browser/rec" "$motus" lab osc.motus -o '-a b#%41?$(touch owned)"'"'"';&.html'
that "... is printed as it is" is "$(cat "$out")" '-a b#%41?$(touch owned)"'"'"';&.html'
that "... is one address" is "$(recorded)" "file://$place/-a%20b%23%2541%3F%24(touch%20owned)%22%27%3B%26.html"
that "... and no command" absent owned
cp osc.motus -- -x.motus
gives "a model with a leading dash" 0 env BROWSER="$place/a browser/rec" "$motus" lab -- -x.motus
that "... is one address too" is "$(recorded)" "file://$place/-x-lab.html"
gives "the first of several that is there" 0 env BROWSER="nowhere::$place/a browser/rec:false" "$motus" lab osc.motus
that "... is started" is "$(recorded)" "file://$place/osc-lab.html"
gives "--no-open" 0 env BROWSER="$place/a browser/rec" "$motus" lab osc.motus --no-open
gives "-o - opens nothing" 0 env BROWSER="$place/a browser/rec" "$motus" lab osc.motus -o -
sleep 0.2
that "... indeed" absent "$RECORD"
for opener in xdg-open open; do cp "a browser/rec" "bin/$opener"; done
gives "without BROWSER: the system's" 0 env PATH="$place/bin:$PATH" "$motus" lab osc.motus
that "... is started" is "$(recorded)" "file://$place/osc-lab.html"
gives "a BROWSER that is more than a name: the system's understands it" 0 env PATH="$place/bin:$PATH" BROWSER="firefox -P work %s" "$motus" lab osc.motus
that "... is started" is "$(recorded)" "file://$place/osc-lab.html"
rm bin/*
gives "no browser at all" 0 env PATH="$place/bin" BROWSER=nowhere "$motus" lab osc.motus
that "... the path" is "$(cat "$out")" osc-lab.html
that "... and what to do with it" says "no browser could be started: open $place/osc-lab.html" "$err"
that "... the page is there" cmp osc-lab.html model-lab.html

# The examples of --help are commands that work.
"$motus" lab --help >help
mkdir examples && ln -s "$root/models" examples/models
sed -n '/^examples:/,$p' help | sed -e 1d -e ':a; /\\$/N; s/\\\n *//; ta' | while read -r line; do
    (cd examples && PATH=$(dirname "$motus"):$PATH BROWSER=true bash -c "$line" >/dev/null 2>"$err") && echo "ok $line" || echo "not $line: $(cat "$err")"
done >ran
that "the examples of lab work" eval "grep -q ^ok ran && ! grep ^not ran"

echo "$passed passed, $failed failed"
[ $failed = 0 ]
