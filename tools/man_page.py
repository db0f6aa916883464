#!/usr/bin/env python3
"""Writes ursula.1 from what the program says of itself.

    tools/man_page.py PROGRAM OUTPUT
"""

import re
import subprocess
import sys
from pathlib import Path


def said_by(program, *arguments):
    text = subprocess.run([program, *arguments], check=True, capture_output=True, text=True).stdout
    return text.replace(program, "ursula").rstrip()


def roff(text):
    """Text as it stands: no line is a request, no hyphen a dash."""
    return "\n".join("\\&" + line.replace("\\", "\\e").replace("-", "\\-") if line else "" for line in text.splitlines())


def block(text):
    return f".nf\n{roff(text)}\n.fi\n"


def page(program):
    version = said_by(program, "--version").split()[0]
    what, _, rest = said_by(program, "--help").partition("\n")
    verbs = re.findall(r"^  ([a-z-]+)  +\S", rest.partition("Subcommands:")[2], re.M)
    if not verbs:
        sys.exit(f"man_page: {program} --help lists no subcommands")
    out = f'.TH URSULA 1 "" "ursula {version}" "User commands"\n.SH NAME\n'
    out += f"ursula \\- {roff(what.partition(': ')[2])}\n"
    out += ".SH SYNOPSIS\n" + "".join(f".B ursula {verb}\n[OPTIONS] \\&...\n.br\n" for verb in verbs)
    out += ".SH DESCRIPTION\n" + block(rest.strip()) + ".SH VERBS\n"
    for verb in verbs:
        out += f".SS {verb}\n" + block(said_by(program, verb, "--help"))
    out += (".SH EXIT STATUS\n0 passed, 1 a check failed, 2 bad input or usage and nothing written, 3 inconclusive.\n"
            ".SH FILES\n.I /usr/share/ursula/scenarios\nscenarios that ship\n")
    return out


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    Path(sys.argv[2]).write_text(page(sys.argv[1]), encoding="utf-8")
