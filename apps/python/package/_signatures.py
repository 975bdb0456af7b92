"""Gives functions of the module the signatures of their stubs, for help() and keyword completion."""

import ast
import functools
import inspect
from typing import Any, Callable, TypeVar, cast

Function = TypeVar("Function", bound=Callable[..., Any])


def with_signature(function: Function) -> Function:
    """Wraps `function` so that inspect.signature() lists all its keywords."""
    declaration, text, _ = function.__nb_signature__[0]  # type: ignore[attr-defined]
    definition = ast.parse(declaration + ": ...").body[0]
    assert isinstance(definition, ast.FunctionDef)
    names = definition.args
    kinds = [(names.args, inspect.Parameter.POSITIONAL_OR_KEYWORD, inspect.Parameter.empty),
             (names.kwonlyargs, inspect.Parameter.KEYWORD_ONLY, None)]

    @functools.wraps(function, updated=())
    def wrapper(*arguments: Any, **options: Any) -> Any:
        return function(*arguments, **options)

    wrapper.__signature__ = inspect.Signature(  # type: ignore[attr-defined]
        [inspect.Parameter(name.arg, kind, default=default) for group, kind, default in kinds for name in group])
    wrapper.__doc__ = text
    del wrapper.__wrapped__  # type: ignore[attr-defined]
    return cast(Function, wrapper)
