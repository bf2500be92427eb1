"""Copies the docstrings of the built module into its stubs, where editors look for them.

Run it after a change of documentation: python python/stub_docs.py && ruff check --fix -q python && ruff format python
"""

import ast
import importlib
import inspect
import sys
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

PACKAGE = Path(__file__).parent / "bryla"
MODULES = ("_bryla", "quaternion", "rotation")

Documented = ast.ClassDef | ast.FunctionDef


def documented(tree: ast.Module, module: ModuleType) -> Iterator[tuple[Documented, str]]:
    """The public classes, methods, properties and functions of a stub, with the docs of the real ones."""
    parents: list[tuple[ast.Module | ast.ClassDef, Any]] = [(tree, module)]
    for parent, real in parents:
        for node in parent.body:
            if not isinstance(node, Documented) or node.name.startswith("_"):
                continue
            if any(isinstance(decorator, ast.Attribute) for decorator in node.decorator_list):
                continue  # the setter of a property
            item = getattr(real, node.name)
            yield node, inspect.getdoc(item) or ""
            if isinstance(node, ast.ClassDef):
                parents.append((node, item))


def main() -> None:
    """Writes the stubs."""
    # the built package, not the sources beside this file
    sys.path = [place for place in sys.path if Path(place).resolve() != PACKAGE.parent]
    for name in MODULES:
        path = PACKAGE / f"{name}.pyi"
        tree = ast.parse(path.read_text(encoding="utf-8"))
        for node, doc in documented(tree, importlib.import_module(f"bryla.{name}")):
            if ast.get_docstring(node) is not None or is_ellipsis(node.body[0]):
                del node.body[0]
            depth = node.col_offset + 4
            indented = doc.replace("\n", "\n" + " " * depth).replace("\n" + " " * depth + "\n", "\n\n")
            ending = "\n" + " " * depth if "\n" in doc else ""
            node.body.insert(0, ast.Expr(ast.Constant(indented + ending)))
        path.write_text(ast.unparse(tree) + "\n", encoding="utf-8")


def is_ellipsis(node: ast.stmt) -> bool:
    """Whether a body is `...`."""
    return isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant) and node.value.value is ...


if __name__ == "__main__":
    main()
