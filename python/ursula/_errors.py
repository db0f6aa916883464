"""Reports wrong arguments in Python's words, because the binding's name C++ types."""

import functools
import inspect
import os
import re

_KINDS = {"float": "a number", "int": "an integer", "str": "a string", "bool": "True or False", "dict": "a dict", "slice": "a slice"}
_FITS = {"float": lambda x: hasattr(x, "__float__") or hasattr(x, "__index__"), "int": lambda x: hasattr(x, "__index__"),
         "str": lambda x: isinstance(x, str), "bool": lambda x: isinstance(x, bool), "dict": lambda x: isinstance(x, dict)}
_FITS["slice"] = lambda x: isinstance(x, slice)
_PATH = re.compile(r"PathLike|\bPath\b")


def _signature(text):
    """Parses the first line of a binding's docstring, `name(s: T, *, jobs: int = 0) -> R`."""
    inside = text[text.index("(") + 1:text.rindex(")", 0, (text + " ->").index(" ->"))]
    parameters, kind = [], inspect.Parameter.POSITIONAL_OR_KEYWORD
    for part in re.split(r",\s*(?![^\[\(]*[\]\)])", inside):
        if part == "*":
            kind = inspect.Parameter.KEYWORD_ONLY
        elif part:
            name, _, rest = part.partition(":")
            kind_of, has_default, default = rest.strip().partition(" = ")
            parameters.append(inspect.Parameter(name.strip(), kind, annotation=kind_of,
                                                default=default if has_default else inspect.Parameter.empty))
    return inspect.Signature(parameters)


def _expected(annotation):
    """Returns the type in words and a test of values; None if any value is allowed."""
    optional = re.fullmatch(r"(?:typing\.)?Optional\[(.*)\]", annotation)
    if optional:
        inner = _expected(optional[1])
        return inner and (inner[0] + " or None", lambda x: x is None or inner[1](x))
    if annotation == "Union[float, str]":
        return "a number, a share such as '0.1%'", lambda x: _FITS["float"](x) or _FITS["str"](x)
    if _PATH.search(annotation):
        return "a path", lambda x: isinstance(x, (str, os.PathLike))
    if annotation in _KINDS:
        return _KINDS[annotation], _FITS[annotation]
    listed = re.fullmatch(r"(?:typing\.)?(?:List|list)\[(.*)\]", annotation)
    if listed:
        inner = _expected(listed[1]) or ("value", lambda x: True)
        return "a list, each " + inner[0], lambda x: isinstance(x, (list, tuple)) and all(map(inner[1], x))
    if "ursula" in annotation:
        name = annotation.rsplit(".", 1)[-1]
        return "ursula." + name, lambda x: type(x).__name__ == name
    return None


def _shown(value):
    text = repr(value)
    return "None" if value is None else f"{text if len(text) < 60 else 'a value'} of type {type(value).__name__}"


def _words(called, doc, arguments, named):
    """Says what is wrong with a call that the binding refused."""
    if "Overloaded function." in doc:
        signatures = [_signature(line[line.index(". ") + 2:]) for line in doc.splitlines() if re.match(r"\d+\. ", line)]
        kinds = [_expected([*each.parameters.values()][-1].annotation) for each in signatures]
        return f"{called}: {_shown(arguments[-1])}, expected {' or '.join(kind[0] for kind in kinds if kind)}"
    try:
        signature = _signature(doc.splitlines()[0])
        bound = signature.bind(*arguments, **named)
    except TypeError as error:
        return f"{called}: {error}"
    for name, value in bound.arguments.items():
        expected = _expected(signature.parameters[name].annotation)
        if expected and not expected[1](value):
            return f"{called}: {name} is {_shown(value)}, expected {expected[0]}"
    return f"{called}: arguments of other types than expected, see help"


def in_words(function, called):
    """Wraps the function so that it refuses arguments in words."""

    @functools.wraps(function)
    def wrapped(*arguments, **named):
        try:
            return function(*arguments, **named)
        except TypeError as error:
            if "(): incompatible " not in str(error).split("\n", 1)[0]:
                raise
        raise TypeError(_words(called, function.__doc__, arguments, named))

    return wrapped


def _unmade(name):
    def refuse(self, *arguments, **named):
        raise TypeError(f"{name}: results of functions are such objects, no call makes one; help(ursula.{name}) says more")

    return refuse


def put_in_words(classes):
    """Wraps every method of these classes that takes arguments, and refuses calls of those without a constructor."""
    for each in classes:
        if not (issubclass(each, Exception) or inspect.isfunction(each.__init__) or (each.__init__.__doc__ or "").startswith("__init__(")):
            each.__init__ = _unmade(each.__name__)
        for name, method in vars(each).copy().items():
            takes = callable(method) and (method.__doc__ or "").startswith(name + "(")
            if takes and name not in ("__setstate__", "__getstate__", "__reduce__"):
                setattr(each, name, in_words(method, f"{each.__name__}.{name}" if name != "__init__" else each.__name__))
