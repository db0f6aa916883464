#!/usr/bin/env bash
# Adds a toy check, trajectory, engine, kind of leg, verb and key to a copy of the tree in FOLDER, builds it and looks for
# them in what the program says and does: tools/try_toys.sh FOLDER
set -euo pipefail

folder=$1
rm -rf "$folder"
mkdir -p "$folder"
git ls-files -z --cached --others --exclude-standard | xargs -0 ls -d 2>/dev/null | tar -cf - -T - | tar -xf - -C "$folder"
[[ ! -e .deps ]] || ln -s "$PWD/.deps" "$folder/.deps"
python3 tools/toys.py add "$folder"
cmake -S "$folder" -B "$folder/build" -G Ninja -DURSULA_TESTS=OFF -DURSULA_BENCH=OFF -DURSULA_PYTHON=OFF
cmake --build "$folder/build" --target ursula
python3 tools/toys.py look "$folder/build/ursula"
