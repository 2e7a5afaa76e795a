#!/bin/bash
# Archives, shards and states whose bytes were changed at random: every command that reads them ends with a status of 0 to 2 and, if
# not 0, with a message; never by a signal, and no sanitizer complains. Where build/asan/motus is there, that is tested.
#
#   HOSTILE_SECONDS=n   how long (15)      SEED=n   of the changes (the clock)
#
# The last line counts the cases: one for each sort of file.
cd "$(dirname "$0")/.." || exit 1
. test/cli/cases.sh
for program in build/asan/motus "$motus"; do [ -x "$program" ] && break; done
program=$(realpath "$program")
export ASAN_OPTIONS=detect_leaks=1:allocator_may_return_null=1:max_allocation_size_mb=2048 UBSAN_OPTIONS=halt_on_error=1
swing_until 2 >"$place/swing.motus"
cd "$place" || exit 1
vary=(--vary "x(0)=0.1:3:9000" --record final -q)
if ! "$motus" sweep swing.motus "${vary[@]}" -o sweep.h5 2>"$err"; then
    that "without HDF5 a message says so; not run: hostile files" says "without HDF5" "$err"
    echo "$passed passed, $failed failed"
    exit 0
fi
for kind in h5 csv npy; do for k in 1 2; do "$motus" sweep swing.motus "${vary[@]}" --shard $k/2 -o "part%K.$kind"; done; done
"$motus" run swing.motus -q -o run.h5 --checkpoint "3 steps"
printf '%s\n' 'r[i]'"''"' = -r[i]  for i = 1..3' 'r[i](0) = (i, 1, 0)  for i = 1..3' "r[i]'(0) = (0, i, 1)  for i = 1..3" 'method verlet' 'step 0.125' 'until 5' >many.motus
"$motus" run many.motus -q -o many.h5
"$motus" sweep swing.motus "${vary[@]}" -o packed.h5 --compress
"$motus" run swing.motus -q -o short.h5 --checkpoint "3 steps" --compress
cat >change.py <<'P'
import random, subprocess, sys, time, os, shutil
program, seconds, seed = sys.argv[1], float(sys.argv[2]), int(sys.argv[3])
random.seed(seed)
print('SEED=%d' % seed, flush=True)
MASK = (1 << 64) - 1
def hashed(data):                       # archive/directory.c
    h, prime = 0x6d6f747573313031, 0x100000001B3 | 0x9E3779B900000000
    for k in range(0, len(data) // 8 * 8, 8):
        h = (h ^ int.from_bytes(data[k:k + 8], 'little')) * prime & MASK
        h ^= h >> 32
    for b in data[len(data) // 8 * 8:]:
        h = (h ^ b) * prime & MASK
        h ^= h >> 32
    return h
def change(data):
    data = bytearray(data)
    archive = data.startswith(b'motus archive')
    for _ in range(random.choice((1, 1, 2, 4, 16))):
        at = random.randrange(min(len(data), random.choice((200, 4096, len(data)))))
        how = random.randrange(7)
        if how == 0: data[at] ^= 1 << random.randrange(8)
        elif how == 1: data[at] = random.choice(b'0123456789 \n/x[]-\0\xff')
        elif how == 2: del data[at:at + random.choice((1, 2, 8, 100))]
        elif how == 3: data[at:at] = data[at:at + random.choice((1, 8, 60))]
        elif how == 4: data[at:at + 20] = b'%020d' % random.choice((0, 1, 4095, 2**31, 2**32, 2**63 - 1, 2**63, 2**64 - 1))
        elif how == 5 and random.random() < 0.2: del data[at:]
        elif how == 6: data[at:at + 8] = random.randbytes(8)
        if not data: data = bytearray(b'm')
    if archive and random.random() < 0.7:   # a hash that fits
        second = data.find(b'\n')
        end = data.find(b'\n', second + 1)
        stop = data.find(b'\0', end)
        if 0 < second < end < stop < 1 << 20:
            line = data[second + 1:end].split(b' ')
            if len(line) == 3:
                line[2] = b'%016x' % hashed(bytes(data[end + 1:stop]))
                data[second + 1:end] = b' '.join(line)
    return bytes(data)
sweep = ['sweep', 'swing.motus', '--vary', 'x(0)=0.1:3:9000', '--record', 'final', '-q']
commands = {
    'sweep.h5': [['archive', 'F'], ['archive', 'F', '-o', 'x.csv', '--force'], ['archive', 'F', '--verify', '1%', '--machine', 'interpreter'],
                 sweep + ['-o', 'F', '--resume', '--machine', 'interpreter']],
    'run.h5': [['archive', 'F'], ['archive', 'F', '-o', 'x.csv', '--force'], ['archive', 'F', '-o', 'x.state', '--force'],
               ['archive', 'F', '--verify', 'all'], ['run', 'F', '--until', '3', '-q'], ['run', 'swing.motus', '-q', '-o', 'F', '--resume']],
    'many.h5': [['archive', 'F', '-o', 'x.csv', '--force'], ['archive', 'F', '--verify', 'all'], ['run', 'F', '--until', '6', '-q']],
    'packed.h5': [['archive', 'F'], ['archive', 'F', '-o', 'x.csv', '--force'], sweep + ['-o', 'F', '--resume', '--machine', 'interpreter']],
    'short.h5': [['archive', 'F', '-o', 'x.csv', '--force'], ['archive', 'F', '--verify', 'all'], ['run', 'F', '--until', '3', '-q']],
    'part1.h5': [['merge', 'F', 'part2.h5', '-o', 'x.h5', '--force', '-q'], ['merge', 'F', '-o', 'x.h5', '--force', '-q', '--partial']],
    'part1.csv': [['merge', 'F', 'part2.csv', '-o', 'y.csv', '--force', '-q']],
    'part1.csv.check': [['merge', 'h.csv', 'part2.csv', '-o', 'y.csv', '--force', '-q']],
    'part1.npy': [['merge', 'F', 'part2.npy', '-o', 'y.npy', '--force', '-q']],
    'part1.npy.json': [['merge', 'F', 'part2.npy', '-o', 'y.npy', '--force', '-q']],
}
bad = {name: 0 for name in commands}
runs = dict(bad)
until, names = time.monotonic() + seconds, list(commands)
while time.monotonic() < until:
    name = random.choice(names)
    with open(name, 'rb') as f: data = change(f.read())
    file = 'h' + name[name.index('.'):]
    with open(file, 'wb') as f: f.write(data)
    if name == 'part1.npy': shutil.copy('part1.npy.json', 'h.npy.json')
    if name == 'part1.npy.json': shutil.copy('part1.npy', 'h.npy')
    if name == 'part1.csv.check': shutil.copy('part1.csv', 'h.csv')
    words = [{'F': 'h.npy' if name.endswith('.json') else file}.get(w, w) for w in random.choice(commands[name])]
    try:
        done = subprocess.run([program] + words, stdin=subprocess.DEVNULL, capture_output=True, timeout=60)
        wrong = done.returncode not in (0, 1, 2) or b'Sanitizer' in done.stderr or b'runtime error' in done.stderr or \
            (done.returncode != 0 and not done.stderr)
        told = done.stderr[-1500:].decode('utf8', 'replace')
    except subprocess.TimeoutExpired:
        wrong, told = True, 'no end after 60 s'
    runs[name] += 1
    if wrong:
        bad[name] += 1
        kept = os.path.join(os.environ.get('HOSTILE_KEEP', '.'), 'hostile-%d-%s' % (bad[name], name))
        shutil.copy(file, kept)
        print('#', ' '.join(words), kept, told)
for name in names: print('%s - %d changed files of the sort %s' % ('not ok' if bad[name] else 'ok', runs[name], name))
P
$python change.py "$program" "${HOSTILE_SECONDS:-15}" "${SEED:-$(date +%s)}" >said 2>&1
status=$?
cat said
passed=$(grep -c '^ok ' said) failed=$(grep -c '^not ok' said)
[ $status = 0 ] || failed=$((failed + 1))
echo "$passed passed, $failed failed"
[ $failed = 0 ]
