"""The bar that a terminal or a notebook shows while validate() works."""

import functools
import sys
import time

_FROM = 2.0  # s: shorter work shows no bar
_WIDTH = 30


def _is_watched():
    """Whether somebody looks: at a terminal, or at a notebook, whose kernel has no terminal."""
    return sys.stderr.isatty() or type(sys.stderr).__module__.startswith("ipykernel")


class _Bar:
    """Writes one line on standard error, over and over."""

    def __init__(self):
        self.begun, self.drawn = time.monotonic(), 0.0

    def __call__(self, share, now):
        at = time.monotonic()
        if at - self.begun < _FROM or at - self.drawn < 0.1:
            return
        self.drawn = at
        done = round(_WIDTH * share)
        left = f", {(at - self.begun) * (1 - share) / share:.0f} s left" if share > 0.01 else ""
        sys.stderr.write(f"\r[{'#' * done}{'.' * (_WIDTH - done)}] {share:4.0%} {now}{left}".ljust(78))
        sys.stderr.flush()

    def close(self):
        if self.drawn:
            sys.stderr.write("\r" + " " * 78 + "\r")


def with_bar(validate):
    """The same function, with a bar where somebody looks and gave no `progress` of his own."""

    @functools.wraps(validate)
    def shown(*args, progress=None, **more):
        if progress is False or progress is None and not _is_watched():
            return validate(*args, **more)
        if progress is not None and progress is not True:
            return validate(*args, progress=progress, **more)
        bar = _Bar()
        try:
            return validate(*args, progress=bar, **more)
        finally:
            bar.close()

    return shown
