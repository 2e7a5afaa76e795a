#!/bin/bash
# Runs of the example models by random methods into archives, interrupted by random signals at random times: whatever happens, --resume
# ends them with the bytes of the run that nothing happened to; a run that goes on to a later end has those of one run to it, where
# steps have one size; and --verify finds every row computed as it is in the file.
#
#   INTERRUPTED_SECONDS=n   how long (20)      SEED=n   of the choices (the clock)
#
# The last line counts the cases: a run is one.
cd "$(dirname "$0")/.." || exit 1
. test/cli/cases.sh
if ! "$motus" run models/spring.motus --until 1 -q -o "$place/one.h5" 2>"$err"; then
    that "without HDF5 a message says so; not run: runs that are interrupted" says "without HDF5" "$err"
    echo "$passed passed, $failed failed"
    exit 0
fi
cat >"$place/interrupt.py" <<'P'
import filecmp, os, random, signal, subprocess, sys, time
motus, place, seconds, seed = sys.argv[1], sys.argv[2], float(sys.argv[3]), int(sys.argv[4])
random.seed(seed)
print('SEED=%d' % seed, flush=True)
models = sorted('models/' + m for m in os.listdir('models') if m.endswith('.motus'))
methods = ['verlet', 'rk4', 'leapfrog', 'pefrl', 'forest-ruth', 'dopri5', 'dop853', 'taylor', 'radau15', 'gauss4', 'symplectic-euler',
           'euler', 'velocity-verlet', 'beeman', 'verner9', 'rk2', 'newmark', 'implicit-midpoint', 'yoshida8']
one, two = place + '/one.h5', place + '/two.h5'
def run(*words):
    return subprocess.run([motus] + list(words), stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=120)
def told(what, words, more=b''):
    print('not ok - %s: %s' % (what, ' '.join("'%s'" % w for w in words)), more.decode('utf8', 'replace').strip()[-200:], '(seed %d)' % seed)
def remove(*files):
    for f in files:
        if os.path.exists(f): os.remove(f)
good = bad = stops = 0
end = time.monotonic() + seconds
while time.monotonic() < end:
    until = random.choice([0.5, 1, 3, 7.3, 20, 100]) * (-1 if random.random() < 0.1 else 1)
    words = ['run', random.choice(models), '--until', repr(until), '--method', random.choice(methods), '--error', 'none', '-q',
             '--machine', 'interpreter']
    every = random.choice([None, None, '1 steps', '3 steps', '7 steps', '0.1', '0.03', '0.0017', '1/64'])
    if every: words += ['--every', every]
    if random.random() < 0.3: words += ['--step', random.choice(['0.01', '1/64', '0.003'])]
    if random.random() < 0.2: words += ['--when', 't = 0.77: record']
    remove(one, two)
    began = time.monotonic()
    try: whole = subprocess.run([motus] + words + ['-o', one], capture_output=True, timeout=4)
    except subprocess.TimeoutExpired: continue
    took = time.monotonic() - began
    if whole.returncode or os.path.getsize(one) > 40e6: continue # the method does not admit the model, or the motion ends
    often = ['37 steps', '100 steps'] if took < 0.05 else [] # every state is written to the disk
    words += ['--checkpoint', random.choice(often + ['5003 steps', '0.01s', '10min', '10min'])]
    for _ in range(random.choice([1, 1, 2, 4])):
        job = subprocess.Popen([motus] + words + ['-o', two, '--resume'], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL)
        time.sleep(random.random() * max(took, 0.01))
        job.send_signal(random.choice([signal.SIGKILL, signal.SIGTERM, signal.SIGINT]))
        stops += job.wait() != 0
    there = os.path.exists(two) and os.path.getsize(two) > 0
    try: done = run(*(['run', two, '-q'] if there and random.random() < 0.5 else words + ['-o', two, '--resume']))
    except subprocess.TimeoutExpired:
        told('no end after 120 s', words)
        bad += 1
        continue
    failed = done.returncode or not filecmp.cmp(one, two, False)
    if failed: told('interrupted', words, done.stdout)
    if not failed and b' --tolerance ' not in open(one, 'rb').read(6000) and abs(until) > 1 and random.random() < 0.5:
        middle = until * random.choice([0.5, 0.31, random.random()])
        first = list(words)
        first[3] = repr(middle)
        remove(two)
        if run(*first, '-o', two).returncode == 0:
            done = run('run', two, '--until', repr(until), '-q')
            failed = done.returncode or not filecmp.cmp(one, two, False)
            if failed: told('on from %r' % middle, words, done.stdout)
    if not failed and random.random() < 0.2:
        done = run('archive', one, '--verify', 'all')
        failed = done.returncode
        if failed: told('verified', words, done.stdout)
    left = [f for f in os.listdir(place) if '.grown' in f or f.endswith('.new')]
    if left and not failed: told('left behind ' + left[0], words); failed = True
    remove(*[place + '/' + f for f in left])
    good, bad = good + (not failed), bad + bool(failed)
print('%d runs, interrupted %d times, SEED=%d' % (good + bad, stops, seed))
print('%d passed, %d failed' % (good, bad))
sys.exit(bad > 0)
P
$python "$place/interrupt.py" "$motus" "$place" "${INTERRUPTED_SECONDS:-20}" "${SEED:-$(date +%s)}"
