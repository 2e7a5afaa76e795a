"""Draws the results of the bench for the README: how many times as long as motus the others take, on one logarithmic axis.

    python3 bench/chart.py bench/results/MACHINE.txt >bench/results/chart.svg

Lines that were not measured are left out. The colours follow the reader's, light or dark; the numbers stand beside the bars.
"""
import math
import re
import sys

# What a group is called, the section it comes from, and its lines: how they begin there, and what they are called here.
GROUPS = [
    ("65 536 driven oscillators, Runge-Kutta 4, one core", "An ensemble of 65536 driven", [
        ("rk4: by hand, our bits", "by hand, the same bits"), ("rk4: odeint", "Boost odeint, blocks"), ("rk4: SciPy", "SciPy"),
        ("rk4: GSL", "GSL"), ("rk4: SUNDIALS", "SUNDIALS")]),
    ("the same, velocity Verlet", "An ensemble of 65536 driven", [
        ("velocity-verlet: by hand, our bits", "by hand, the same bits"), ("velocity-verlet: odeint", "Boost odeint, blocks")]),
    ("65 536 pendulums, velocity Verlet, one core", "An ensemble of 65536 pendulums", [
        ("velocity-verlet: by hand", "by hand, sine of 4 ulp")]),
    ("one driven oscillator, Verlet", "One driven oscillator", [("a plain loop", "a loop in C")]),
    ("a chain of a million cells, one core", "A chain", [
        ("by hand, the best with our bits, one", "by hand, the same bits"), ("by hand, two plain", "two loops in C"), ("odeint", "Boost odeint")]),
    ("gravity among a thousand bodies, one core", "Gravity", [("by hand, root and division", "by hand, the same bits")]),
    ("1e5 steps of an oscillator, whole program", "The founding examples", [
        ("driven oscillator, 1e5 steps: numba", "numba"), ("driven oscillator, 1e5 steps: NumPy", "NumPy")]),
]

WIDTH, LEFT, RIGHT, ROW, HEAD = 720, 200, 70, 20, 30


def read(file):
    """{section: {line: how many times as long as motus}}, and the line about the machine."""
    sections, current, machine = {}, None, ""
    with open(file, encoding="utf-8") as lines:
        for number, line in enumerate(lines):
            line = line.rstrip("\n")
            if number == 0:
                machine = line
            elif line and not line.startswith(" "):
                if "  ours  " not in line:
                    current = sections.setdefault(line, {})
            else:
                # name, ours, other, ratio, limit: a ratio that must be large is other/ours, any other is ours/other
                found = re.match(r"  (\S.*?) {2,}[\d.]+ (?:ns|ms) +[\d.]+ (?:ns|ms) +([\d.]+)( +>=)?", line)
                if found and current is not None and float(found[2]):
                    current[found[1]] = float(found[2]) if found[3] else 1 / float(found[2])
    return sections, machine


def chosen(sections):
    for title, section, lines in GROUPS:
        values = next((v for k, v in sections.items() if k.startswith(section)), {})
        rows = [(label, value) for start, label in lines for name, value in values.items() if name.startswith(start)]
        if rows:
            yield title, rows


def times(value):
    return f"{value:.2f}×" if value < 10 else f"{value:.0f}×"


def draw(groups, machine):
    most = max(value for _, rows in groups for _, value in rows)
    least = min(0.5, min(value for _, rows in groups for _, value in rows))
    low, high = math.log10(least) - 0.02, math.ceil(math.log10(most) * 2) / 2

    def at(value):
        return LEFT + (math.log10(value) - low) / (high - low) * (WIDTH - LEFT - RIGHT)

    height = 64 + sum(HEAD + ROW * len(rows) for _, rows in groups) + 34
    machine = machine.split(" on ", 1)[-1].replace("&", "&amp;").replace("<", "&lt;")
    print(f'''<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height}" width="{WIDTH}" height="{height}" role="img" aria-labelledby="t d">
<title id="t">How many times as long as motus the others take</title>
<desc id="d">{"; ".join(f"{title}: " + ", ".join(f"{label} {times(value)}" for label, value in rows) for title, rows in groups)}.</desc>
<style>
  .paper {{ fill: #ffffff }} .ink {{ fill: #1f2328 }} .faint {{ fill: #59636e }} .grid {{ stroke: #d1d9e0 }} .one {{ stroke: #1a7f37; stroke-width: 2 }}
  .motus {{ fill: #1a7f37 }} .bar {{ fill: #54708f }} text {{ font: 13px system-ui, -apple-system, "Segoe UI", sans-serif }} .head {{ font-weight: 600; paint-order: stroke; stroke: #ffffff; stroke-width: 6px }}
  @media (prefers-color-scheme: dark) {{
    .paper {{ fill: #0d1117 }} .ink {{ fill: #e6edf3 }} .faint {{ fill: #9198a1 }} .grid {{ stroke: #30363d }} .one {{ stroke: #3fb950 }}
    .motus {{ fill: #3fb950 }} .bar {{ fill: #7d9cc0 }} .head {{ stroke: #0d1117 }}
  }}
</style>
<rect class="paper" width="{WIDTH}" height="{height}" rx="6"/>
<text class="ink head" x="16" y="26">How many times as long as motus the others take</text>
<text class="motus" x="{at(1):.1f}" y="48" text-anchor="middle">motus = 1</text>''')
    bottom = height - 30
    for power in range(math.ceil(low), math.floor(high) + 1):
        if power:
            print(f'<line class="grid" x1="{at(10**power):.1f}" x2="{at(10**power):.1f}" y1="56" y2="{bottom}"/>'
                  f'<text class="faint" x="{at(10**power):.1f}" y="48" text-anchor="middle">{10**power}×</text>')
    print(f'<line class="one" x1="{at(1):.1f}" x2="{at(1):.1f}" y1="56" y2="{bottom}"/>')
    y = 56
    for title, rows in groups:
        y += HEAD
        print(f'<text class="ink head" x="16" y="{y - 8}">{title}</text>')
        for label, value in rows:
            x, end = sorted((at(1), at(value)))
            print(f'<text class="ink" x="{LEFT - 8}" y="{y + 13}" text-anchor="end">{label}</text>'
                  f'<rect class="bar" x="{x:.1f}" y="{y + 3}" width="{max(end - x, 2):.1f}" height="{ROW - 7}" rx="2"/>'
                  f'<text class="ink" x="{end + 6:.1f}" y="{y + 13}">{times(value)}</text>')
            y += ROW
    print(f'<text class="faint" x="16" y="{height - 10}">{machine}</text>\n</svg>')


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    everything, where = read(sys.argv[1])
    drawn = list(chosen(everything))
    if not drawn:
        sys.exit(f"chart.py: nothing in {sys.argv[1]} has both sides measured")
    draw(drawn, where)
