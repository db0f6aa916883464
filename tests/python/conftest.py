import os
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture
def helix():
    return ROOT / "scenarios" / "paper-helix.toml"


@pytest.fixture
def quick(helix, tmp_path):
    """The helix with few instants, for speed."""
    file = tmp_path / "quick.toml"
    file.write_text(helix.read_text() + "\n[simulation]\nsamples = 11\n")
    return file


@pytest.fixture
def program(tmp_path):
    def call(*arguments):
        return subprocess.run([os.environ["URSULA_PROGRAM"], *map(str, arguments)], cwd=tmp_path, capture_output=True,
                              text=True, check=False)

    return call
