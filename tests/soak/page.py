# SPDX-License-Identifier: Apache-2.0
"""The soak's result as text and as one HTML page with plots over time; no file beside it."""

import html

import judge


def summary(options, soak, rows, whole, held):
    record = soak.record
    cases, delays, _ = judge.detection(record)
    kinds = {}
    for d in record.disturbances:
        kinds[d.kind] = kinds.get(d.kind, 0) + 1
    return {
        "held": held, "whole": whole, "seed": options.seed, "accelerated": options.accelerated,
        "source_time_s": round(soak.t, 1), "wall_time_s": round(soak.wall(), 1),
        "samples_sent": record.seconds[-1]["sent"] if record.seconds else 0,
        "samples_answered": record.seconds[-1]["answered"] if record.seconds else 0,
        "missing_while_down": sum(g["to"] - g["from"] + 1 for g in record.gaps
                                  if (g["during"] or "").startswith(judge.DOWN)),
        "counted_lost": judge.counted_losses(record.statuses),
        "disturbances": kinds, "abrupt_faults": cases,
        "abrupt_fault_delays_s": [round(d, 2) for d in delays],
        "unexplained": [f"{e['at']:.1f} s, {e['during']}: {e['message']}" for e in record.unexplained],
        "unexpected_exits": [f"{name} at {t:.1f} s with {code}" for name, t, code in record.unexpected_exits],
    }


def text(s, rows):
    lines = [f"flown {s['source_time_s']} s in {s['wall_time_s']} s, {s['samples_sent']} samples sent, "
             f"{s['samples_answered']} answered, {s['missing_while_down']} while a service was down, "
             f"{s['counted_lost']} counted as lost; {sum(s['disturbances'].values())} disturbances"]
    lines += [f"  {'held  ' if held else 'BROKEN'}  {name:38} {value:10.4g}   {limit}"
              for name, value, limit, held in rows]
    lines += [f"  unexplained: {line}" for line in s["unexplained"][:20]]
    lines += [f"  ended by itself: {line}" for line in s["unexpected_exits"][:20]]
    if not s["whole"]:
        lines.append("the soak did not come to its end")
    lines.append("every criterion held" if s["held"] else "NOT HELD")
    return "\n".join(lines)


WIDTH, HEIGHT, LEFT, BOTTOM = 960, 150, 60, 22


def nice(value):
    return f"{value:.4g}"


def chart(title, unit, series, end_t, marks):
    """series: [(name, colour, [(t, value)])]; marks: [(t, tooltip)], where something was disturbed."""
    top = max([v for _, _, points in series for _, v in points] + [1e-9]) * 1.08
    w, h = WIDTH - LEFT - 10, HEIGHT - BOTTOM - 8

    def x(t):
        return LEFT + w * t / max(end_t, 1e-9)

    def y(v):
        return 8 + h * (1.0 - v / top)

    parts = [f'<h3>{html.escape(title)} <small>{html.escape(unit)}</small></h3>',
             f'<svg viewBox="0 0 {WIDTH} {HEIGHT}" role="img" aria-label="{html.escape(title)}">']
    for t, tip in marks:
        parts.append(f'<line class="mark" x1="{x(t):.1f}" x2="{x(t):.1f}" y1="8" y2="{8 + h}">'
                     f'<title>{html.escape(tip)}</title></line>')
    for share in (0.0, 0.5, 1.0):
        parts.append(f'<line class="grid" x1="{LEFT}" x2="{WIDTH - 10}" y1="{y(share * top / 1.08):.1f}" '
                     f'y2="{y(share * top / 1.08):.1f}"/><text x="{LEFT - 6}" y="{y(share * top / 1.08) + 4:.1f}" '
                     f'text-anchor="end">{nice(share * top / 1.08)}</text>')
        parts.append(f'<text x="{x(share * end_t):.1f}" y="{HEIGHT - 4}" text-anchor="middle">'
                     f'{nice(share * end_t)} s</text>')
    for name, colour, points in series:
        thin = points[::max(1, len(points) // 1500)]
        path = " ".join(f"{x(t):.1f},{y(v):.1f}" for t, v in thin)
        parts.append(f'<polyline fill="none" stroke="{colour}" points="{path}"><title>{html.escape(name)}</title></polyline>')
    parts.append("</svg><p class=key>" + " ".join(
        f'<span style="color:{colour}">&#9644;</span> {html.escape(name)}' for name, colour, _ in series) + "</p>")
    return "".join(parts)


COLOURS = ("#0b61a4", "#c1440e", "#2e7d32", "#6a3d9a")
STYLE = """body{font:15px/1.45 system-ui,sans-serif;max-width:1000px;margin:2em auto;padding:0 1em;color:#222}
table{border-collapse:collapse}td,th{padding:.2em .8em;border-bottom:1px solid #ddd;text-align:left}
.no{color:#b00020;font-weight:bold}.yes{color:#2e7d32}svg{width:100%}svg text{font-size:11px;fill:#555}
.grid{stroke:#ddd}.mark{stroke:#c1440e;stroke-opacity:.25}.key{margin:0 0 1em;font-size:13px}h3{margin:.6em 0 0}
small{color:#777;font-weight:normal}"""


def charts(soak):
    record, end_t = soak.record, soak.t
    marks = [(d.start_t, f"{d.start_t:.1f} s: {d.kind} {d.about.get('name', '')}") for d in record.disturbances]
    yield chart("Worst error of each second", "published sigmas, clipped at 10", [
        (name, COLOURS[i], [(s["t"], min(10.0, s[key]["worst"])) for s in record.seconds])
        for i, (name, key) in enumerate((("health", "health"), ("thrust, temperatures, margin", "auxiliary")))],
        end_t, marks)
    yield chart("Latency, arrival to EngineHealth written", "ms, since the monitor's start", [
        (name, COLOURS[i], [(s["t"], 1e-3 * s[key]) for s in record.statuses])
        for i, (name, key) in enumerate((("p50", "latency_p50_us"), ("p99", "latency_p99_us"),
                                         ("p99.9", "latency_p999_us")))], end_t, marks)
    for title, unit, quantity in (("Resident memory", "MB", "rss_mb"), ("Open file descriptors", "", "fds")):
        yield chart(title, unit, [(name, COLOURS[i % 4], [(t, u[quantity]) for _w, t, _l, u in samples])
                                  for i, (name, samples) in enumerate(record.usage.items())], end_t, marks)
    yield chart("Samples counted by the monitor since its start", "", [
        (key, COLOURS[i], [(s["t"], s[key]) for s in record.statuses])
        for i, key in enumerate(("lost", "malformed", "reordered", "foreign"))], end_t, marks)


def disturbance_rows(record):
    for d in record.disturbances:
        named = "; ".join(f"{e['message']} (+{e['at'] - d.start_t:.2f} s)" for e in d.events if e["raised"])
        about = " ".join(str(d.about[k]) for k in ("name", "size") if k in d.about)
        yield (f"<tr><td>{d.start_t:.1f}</td><td>{html.escape(d.kind)}</td><td>{html.escape(about)}</td>"
               f"<td>{html.escape(named)}</td></tr>")


def write(path, soak, rows, s):
    table = "".join(
        f"<tr><td>{name.replace('_', ' ')}</td><td>{nice(value)}</td><td>{limit}</td>"
        f"<td class={'yes' if held else 'no'}>{'held' if held else 'broken'}</td></tr>" for name, value, limit, held in rows)
    strays = "".join(f"<li>{html.escape(line)}</li>" for line in s["unexplained"] + s["unexpected_exits"])
    with open(path, "w") as f:
        f.write(f"""<!doctype html><html lang=en><meta charset=utf-8><title>Soak of the engine health monitor</title>
<style>{STYLE}</style><h1>Soak: <span class={'yes' if s['held'] else 'no'}>{'held' if s['held'] else 'not held'}</span></h1>
<p>{s['source_time_s']} s of flight in {s['wall_time_s']} s{' (accelerated)' if s['accelerated'] else ''}, seed {s['seed']};
{s['samples_sent']} samples sent, {s['samples_answered']} answered, {s['missing_while_down']} came while a service was
down, {s['counted_lost']} were counted as lost. {'' if s['whole'] else '<b>It did not come to its end.</b>'}</p>
<table><tr><th>criterion</th><th>measured</th><th>allowed</th><th></th></tr>{table}</table>
{'<h2>Unexplained</h2><ul>' + strays + '</ul>' if strays else ''}
<h2>Over time</h2><p>Vertical lines: something was disturbed (point at one).</p>{''.join(charts(soak))}
<h2>Disturbances</h2><table><tr><th>s</th><th>what</th><th></th><th>raised</th></tr>{''.join(disturbance_rows(soak.record))}</table>
</html>""")
