"""The ranking of a sweep as a page of its own, without scripts and links to elsewhere."""

from __future__ import annotations

import html
from typing import Any

import pandas as pd

from .plan import Plan

_STYLE = """body{font:15px/1.5 sans-serif;max-width:75rem;margin:2rem auto;padding:0 1rem;color:#222}
table{border-collapse:collapse;margin:1rem 0}td,th{padding:.25rem .7rem;border-bottom:1px solid #ddd;text-align:left}
td.n{text-align:right;font-variant-numeric:tabular-nums}code{font-size:12px;word-break:break-all}
.bar{background:#e9b44c;height:.8rem}.bad{color:#a00}svg{margin:0 1rem 1rem 0}"""


def _text(value: Any) -> str:
    if isinstance(value, float):
        return f"{value:.6g}" if value == value else "–"
    return html.escape(str(value).rpartition("/")[2])


def page_of(plan: Plan, table: pd.DataFrame) -> str:
    """All jobs, the best first by the plan's rank_by; a plot of it over each axis of numbers."""
    rank = plan.rank_by if plan.rank_by in table.columns else ""
    ordered = table.sort_values(rank, ascending=not plan.most_is_best, kind="stable", na_position="last") if rank else table
    skip = {"job", "command", "error", "picture_hash", *plan.axes()}
    columns = [*plan.axes(), *(name for name in table.columns if name not in skip)]
    errors = table["error"].notna() if "error" in table.columns else pd.Series(False, index=table.index)
    head = f"<h1>{html.escape(plan.name)}</h1><p>{len(table)} drives"
    head += f", ranked by {html.escape(rank)}, the {'most' if plan.most_is_best else 'least'} first" if rank else ""
    head += f", <span class=bad>{int(errors.sum())} without figures</span>" if errors.any() else ""
    rows = []
    top = float(pd.to_numeric(table[rank], errors="coerce").abs().max()) if rank else 0.0
    for place, (_, row) in enumerate(ordered.iterrows(), 1):
        cells = "".join(f"<td class=n>{_text(row[name])}</td>" for name in columns)
        share = abs(float(row[rank])) / top * 100 if rank and top > 0 and row[rank] == row[rank] else 0.0
        bar = f'<td style="width:8rem"><div class=bar style="width:{share:.1f}%"></div></td>' if rank else ""
        said = f"<p class=bad>{html.escape(str(row['error']))}</p>" if "error" in row and row["error"] == row["error"] else ""
        command = f"<td>{said}<code>{html.escape(str(row['command']))}</code></td>"
        rows.append(f"<tr><td class=n>{place}</td><td class=n>{row['job']}</td>{cells}{bar}{command}</tr>")
    names = "".join(f"<th>{html.escape(name)}</th>" for name in columns)
    plots = "".join(_plot(table, axis, rank) for axis in plan.axes()) if rank else ""
    return (
        f'<!doctype html><html lang="en"><head><meta charset="utf-8"><title>Phare · {html.escape(plan.name)}</title>'
        f"<style>{_STYLE}</style></head><body>{head}.</p>{plots}<table><tr><th>rank</th><th>job</th>{names}"
        f"{'<th></th>' if rank else ''}<th>repeat it</th></tr>{''.join(rows)}</table></body></html>\n"
    )


def _plot(table: pd.DataFrame, axis: str, rank: str) -> str:
    """Points of `rank` over `axis`; nothing where either is no number."""
    x, y = pd.to_numeric(table[axis], errors="coerce"), pd.to_numeric(table[rank], errors="coerce")
    there = x.notna() & y.notna()
    if there.sum() < 2 or x[there].nunique() < 2:
        return ""
    x, y = x[there], y[there]
    span_y = (y.max() - y.min()) or 1.0
    points = "".join(
        f'<circle cx="{50 + 280 * (a - x.min()) / (x.max() - x.min()):.1f}" cy="{170 - 150 * (b - y.min()) / span_y:.1f}" r="3"/>'
        for a, b in zip(x, y)
    )
    return (
        f'<svg width="350" height="215" role="img" aria-label="{html.escape(rank)} over {html.escape(axis)}">'
        f'<g fill="#2a6f97">{points}</g><path d="M45 15V175H335" fill="none" stroke="#555"/><g font-size="11" fill="#333">'
        f'<text x="48" y="190">{_text(float(x.min()))}</text><text x="335" y="190" text-anchor="end">{_text(float(x.max()))}</text>'
        f'<text x="190" y="206" text-anchor="middle">{html.escape(axis)}</text><text x="42" y="174" text-anchor="end">'
        f'{_text(float(y.min()))}</text><text x="42" y="24" text-anchor="end">{_text(float(y.max()))}</text>'
        f'<text x="50" y="12">{html.escape(rank)}</text></g></svg>'
    )
