"""Line charts and the similarity matrix as inline SVG in the page's colours."""

import html
import math

WIDTH, HEIGHT = 520, 300
LEFT, RIGHT, TOP, BOTTOM = 56, 14, 12, 44


def ticks(low, high, count=5):
    """Round values that cover low … high."""
    span = (high - low) or 1.0
    step = 10 ** math.floor(math.log10(span / count))
    step = next(step * f for f in (1, 2, 2.5, 5, 10) if span / (step * f) <= count)
    first = math.ceil(low / step - 1e-9)
    return [step * i for i in range(first, math.floor(high / step + 1e-9) + 1)]


def line_chart(series, x_label, y_label, *, log=False, y_low=0.0, y_high=None, percent_x=False):
    """`series`: (name, [(x, y), …]) each; at most five. With `log` both axes are logarithmic."""
    points = [p for _, line in series for p in line]
    xs, ys = [p[0] for p in points], [p[1] for p in points]
    scale = math.log10 if log else float
    if log:
        low_x, high_x = scale(min(xs) * 0.9), scale(max(xs) * 1.1)
        low_y, high_y = math.floor(scale(min(ys))), math.ceil(scale(max(ys)))
    else:
        low_x, high_x = min(xs), max(xs)
        low_y, high_y = y_low, y_high if y_high is not None else max(ys) * 1.08 or 1.0

    def place(x, y):
        across = (scale(x) - low_x) / ((high_x - low_x) or 1)
        up = (scale(y) - low_y) / ((high_y - low_y) or 1)
        return (LEFT + across * (WIDTH - LEFT - RIGHT), HEIGHT - BOTTOM - up * (HEIGHT - TOP - BOTTOM))

    parts = [f'<svg class="chart" viewBox="0 0 {WIDTH} {HEIGHT}" role="img" '
             f'aria-label="{html.escape(y_label)} against {html.escape(x_label)}">']
    marks_y = [10.0 ** e for e in range(low_y, high_y + 1)] if log else ticks(low_y, high_y)
    for value in marks_y:
        _, y = place(max(xs), value)
        parts.append(f'<line class="axis" x1="{LEFT}" x2="{WIDTH - RIGHT}" y1="{y:.1f}" y2="{y:.1f}"/>'
                     f'<text x="{LEFT - 8}" y="{y + 4:.1f}" text-anchor="end">{value:g}</text>')
    marks_x = [1e4, 2e4, 5e4, 1e5] if log else ticks(low_x, high_x, 6)
    for value in marks_x:
        if not low_x <= scale(value) <= high_x:
            continue
        x, _ = place(value, ys[0])
        text = f"{100 * value:g}%" if percent_x else f"{value:,.0f}" if value >= 1000 else f"{value:g}"
        parts.append(f'<text x="{x:.1f}" y="{HEIGHT - BOTTOM + 18}" text-anchor="middle">{text}</text>')
    middle = (LEFT + WIDTH - RIGHT) / 2
    parts.append(f'<text x="{middle:.0f}" y="{HEIGHT - 6}" text-anchor="middle">{html.escape(x_label)}</text>')
    for number, (_, line) in enumerate(series, 1):
        path = " ".join(f"{x:.1f},{y:.1f}" for x, y in (place(*p) for p in line))
        parts.append(f'<polyline points="{path}" fill="none" stroke="var(--s{number})" stroke-width="2.4" '
                     'stroke-linejoin="round"/>')
        if len(line) <= 20:
            parts += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3.4" fill="var(--s{number})"/>'
                      for x, y in (place(*p) for p in line)]
    parts.append("</svg>")
    legend = "".join(f'<span><i style="background:var(--s{i})"></i>{html.escape(name)}</span>'
                     for i, (name, _) in enumerate(series, 1))
    return f'<div class="legend">{legend}</div><div class="note">{html.escape(y_label)}</div>{"".join(parts)}'


def runs_of(values):
    """(value, first index, length) of runs of equal values."""
    runs = []
    for i, value in enumerate(values):
        if runs and runs[-1][0] == value:
            runs[-1][2] += 1
        else:
            runs.append([value, i, 1])
    return runs


def matrix(categories, best):
    """Rows are queries; the best hits of each are shaded, those of its class in another colour."""
    side, left, top = 816, 132, 118
    cell = side / len(categories)
    parts = [f'<svg class="chart matrix" viewBox="0 0 {left + side + 4} {top + side + 4}" role="img" '
             'aria-label="similarity matrix">',
             f'<rect x="{left}" y="{top}" width="{side}" height="{side}" fill="var(--panel)"/>']
    for name, first, length in runs_of(categories):
        at, size = cell * first, cell * length
        parts.append(f'<rect x="{left + at:.1f}" y="{top + at:.1f}" width="{size:.1f}" height="{size:.1f}" '
                     'fill="var(--accent)" fill-opacity="0.13"/>')
        middle = at + size / 2
        label = html.escape(name)
        parts.append(f'<text x="{left - 8}" y="{top + middle + 5:.1f}" text-anchor="end">{label}</text>')
        parts.append(f'<text transform="translate({left + middle + 4:.1f} {top - 8}) rotate(-90)">{label}</text>')
        for line in (at, at + size):
            parts.append(f'<path class="axis" d="M{left} {top + line:.1f}h{side}M{left + line:.1f} {top}v{side}" '
                         'stroke-width="0.7" fill="none"/>')
    good, bad = [], []
    for row, hits in enumerate(best):
        for hit in hits:
            same = categories[row] == categories[hit]
            (good if same else bad).append(f"M{left + cell * hit:.1f} {top + cell * row:.1f}h{cell:.1f}v{cell:.1f}h-{cell:.1f}z")
    parts.append(f'<path d="{"".join(good)}" fill="var(--s1)"/><path d="{"".join(bad)}" fill="var(--s2)"/></svg>')
    return f'<div class="scroll">{"".join(parts)}</div>'
