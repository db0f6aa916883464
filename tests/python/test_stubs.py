"""The typed stubs say what the module has, no more and no less."""

import ast
from pathlib import Path

import ursula

FOLDER = Path(ursula.__file__).parent


def members(body):
    return {node.name for node in body if isinstance(node, (ast.FunctionDef, ast.ClassDef))}


def public(names):
    return {name for name in names if not name.startswith("_")}


def test_stubs_are_there():
    assert (FOLDER / "py.typed").is_file()


def test_names_are_the_modules():
    stub = ast.parse((FOLDER / "__init__.pyi").read_text())
    assert members(stub.body) == public(ursula.__all__)
    for node in stub.body:
        if isinstance(node, ast.ClassDef) and not node.bases:  # exceptions carry attributes of their own
            of_class = vars(getattr(ursula, node.name))
            assert public(members(node.body)) == public(of_class), node.name


def test_everything_is_explained():
    for name in public(ursula.__all__):
        each = getattr(ursula, name)
        assert each.__doc__ and each.__module__ in ("ursula", "ursula._ursula"), name
    for name in ("motion", "inverse_dynamics", "forward_dynamics"):
        assert "(N, " in getattr(ursula.Scenario, name).__doc__ or "(N,)" in getattr(ursula.Scenario, name).__doc__


def test_arguments_are_the_modules():
    stub = ast.parse((FOLDER / "__init__.pyi").read_text())
    functions = {node.name: node for node in stub.body if isinstance(node, ast.FunctionDef)}
    for name, node in functions.items():
        first_line = getattr(ursula, name).__doc__.splitlines()[0]
        for argument in (*node.args.args, *node.args.kwonlyargs):
            assert argument.arg in first_line, (name, first_line)
