"""What a notebook shows of a result."""

import pathlib
import tempfile
import webbrowser
from html import escape

_COLOURS = {"pass": "#1a7f37", "fail": "#cf222e", "inconclusive": "#9a6700", "not_applicable": "#6e7781"}


def _verdict(word):
    return f'<b style="color:{_COLOURS[word]}">{escape(word)}</b>'


def html(result):
    """Verdict, what was found, and a row for each check that was judged."""
    rows = "".join(
        f"<tr><td>{escape(check.name)}</td><td>{_verdict(check.verdict)}</td><td>{check.value:.3g}</td>"
        f"<td>{check.limit:.3g}</td><td>{escape(check.unit)}</td><td>{escape(check.why)}</td></tr>"
        for check in result.checks if check.verdict != "not_applicable")
    return (f"<p><b>{escape(result.scenario)}</b>: {_verdict(result.verdict)}. {escape(result.sentence)}</p>"
            "<table><thead><tr><th>check</th><th>verdict</th><th>value</th><th>limit</th><th>unit</th><th>what was found"
            f"</th></tr></thead><tbody>{rows}</tbody></table>")


def plot(result):
    """The efforts and their error beside its limit over time, as a figure of Matplotlib.

    Raises ImportError where Matplotlib is not installed, ValueError where nothing was computed.
    """
    try:
        from matplotlib import pyplot
    except ImportError as missing:
        raise ImportError("plot() draws with Matplotlib, which is not installed") from missing
    series = result.timeseries
    if len(series["t_s"]) == 0:
        raise ValueError(f"{result.scenario}: no instant was computed, so there is nothing to plot")
    figure, (above, below) = pyplot.subplots(2, 1, sharex=True, layout="constrained")
    for name, column in series.items():
        if name.startswith("tau_"):
            above.plot(series["t_s"], column, label=name)
    for prefix, style in (("error_tau_", "-"), ("limit_tau_", "--")):
        name = next(each for each in series if each.startswith(prefix))
        below.semilogy(series["t_s"], series[name], style, label=name)
    above.set_title(f"{result.scenario}: {result.verdict}")
    below.set_xlabel("t, s")
    for axes in (above, below):
        axes.legend(fontsize="small")
    return figure


def show(result, height=900):
    """Shows the report: in a notebook below the cell, `height` pixels high; elsewhere in the browser."""
    folder = pathlib.Path(tempfile.mkdtemp(prefix="ursula-"))
    result.write(folder)
    page = folder / "report.html"
    try:
        shell = get_ipython()  # IPython alone defines it
    except NameError:
        shell = None
    if shell is None or not hasattr(shell, "kernel"):
        webbrowser.open(page.as_uri())
        return None
    from IPython.display import HTML
    return HTML(f'<iframe srcdoc="{escape(page.read_text(encoding="utf-8"))}" width="100%" height="{height}"></iframe>')
