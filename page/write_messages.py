"""Writes page/src/messages.ts: the types of all messages, from their declarations in src/bayesmap/app/protocol.

`make page` runs it; tests/app/test_page_build.py fails where the committed file is another.
"""

import json
import re
from collections.abc import Iterator
from contextlib import suppress
from inspect import getsource
from pathlib import Path
from typing import get_args

from msgspec import inspect

from bayesmap.app.exports import Recording
from bayesmap.app.figures import Figure
from bayesmap.app.protocol.actions import Action, AnyAction, Patch
from bayesmap.app.protocol.document import Document
from bayesmap.app.protocol.notices import AnyNotice

TARGET = Path(__file__).parent / "src/messages.ts"
HEAD = "// Built by `make page` from src/bayesmap/app/protocol: edit there.\n"
RENAMED = {"Document": "MapDocument"}
"""Names that TypeScript has for something else."""


def messages() -> str:
    """Return the text of the file."""
    found: dict[str, str] = {}
    for kind in (Document, *get_args(AnyAction), *get_args(AnyNotice), Recording, Figure):
        declare(inspect.type_info(kind), found)
    unions = (union(name, get_args(kinds)) for name, kinds in (("Action", AnyAction), ("Notice", AnyNotice)))
    return "\n".join([HEAD, *found.values(), *unions])


def union(name: str, kinds: tuple[type, ...]) -> str:
    """Return a type that is one of several."""
    return f"export type {name} =\n" + "".join(f"  | {name_of(kind)}\n" for kind in kinds).rstrip() + ";\n"


def declare(kind: inspect.Type, found: dict[str, str]) -> None:
    """Add the declaration of an object's type, and before it those of the types of its fields."""
    for field in kind.fields:
        for inner in objects(field.type):
            declare(inner, found)
    name = name_of(kind.cls)
    if name in found:
        return
    summary, texts = described(kind.cls)
    lines = [f"/** {summary} */", f"export type {name} = {{"]
    if getattr(kind, "tag", None):
        lines.append(f'  type: "{kind.tag}";')
    page_leaves_out = issubclass(kind.cls, Action | Patch)  # the library sends every field
    for field in kind.fields:
        if field.name in texts:
            lines.append(f"  /** {texts[field.name]} */")
        mark = "?" if page_leaves_out and not field.required else ""
        lines.append(f"  {field.encode_name}{mark}: {typescript(field.type)};")
    found[name] = "\n".join([*lines, "};", ""])


def objects(kind: inspect.Type) -> Iterator[inspect.Type]:
    """The types of objects in a type."""
    if isinstance(kind, inspect.StructType | inspect.DataclassType):
        yield kind
    for inner in (getattr(kind, "type", None), getattr(kind, "item_type", None)):
        if isinstance(inner, inspect.Type):
            yield from objects(inner)
    for inner in (*getattr(kind, "types", ()), *getattr(kind, "item_types", ())):
        yield from objects(inner)


def typescript(kind: inspect.Type) -> str:
    """Return the TypeScript of a type."""
    match kind:
        case inspect.Metadata():
            return typescript(kind.type)
        case inspect.UnionType():
            return " | ".join(map(typescript, kind.types))
        case inspect.LiteralType():
            return " | ".join(map(json.dumps, sorted(kind.values)))
        case inspect.IntType() | inspect.FloatType():
            return "number"
        case inspect.BoolType():
            return "boolean"
        case inspect.StrType() | inspect.BytesType():
            return "string"
        case inspect.NoneType():
            return "null"
        case inspect.TupleType():
            return f"[{', '.join(map(typescript, kind.item_types))}]"
        case inspect.CollectionType():
            inner = typescript(kind.item_type)
            return f"({inner})[]" if "|" in inner else f"{inner}[]"
        case inspect.DictType():
            return "object"
    return name_of(kind.cls)


def name_of(kind: type) -> str:
    """Return the name of a type in TypeScript."""
    return RENAMED.get(kind.__name__, kind.__name__)


def described(kind: type) -> tuple[str, dict[str, str]]:
    """Return the text of a class, and the texts of its fields and of its bases' fields.

    A field is described by the comment above or beside it, or under Attributes in the docstring.
    """
    texts: dict[str, str] = {}
    for base in reversed(kind.__mro__[: kind.__mro__.index(Action) if issubclass(kind, Action) else None]):
        texts |= dict(re.findall(r"^ {8}(\w+): (.*(?:\n {12}.*)*)", base.__doc__ or "", flags=re.M))
        source = ""
        with suppress(OSError, TypeError):  # a class made by a call has no source
            source = getsource(base)
        for above, name, beside in re.findall(r"((?:^ {4}# .*\n)*)^ {4}(\w+): .*?(?:  # (.*))?$", source, flags=re.M):
            text = beside or above.replace("# ", "")
            if text:
                texts[name] = text.strip().removesuffix(".") + "."
    summary, *paragraphs = (kind.__doc__ or "").split("\n\n")
    buffers = [text for text in paragraphs if text.strip().startswith("Buffers")]
    return sentence(" ".join([summary, *buffers])), {name: sentence(text) for name, text in texts.items()}


def sentence(text: str) -> str:
    """Return a text on one line, with a capital."""
    line = " ".join(text.split())
    return line[:1].upper() + line[1:]


if __name__ == "__main__":
    TARGET.write_text(messages(), encoding="utf-8")
