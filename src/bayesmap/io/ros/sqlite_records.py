"""The messages of a rosbag2 database in the order of their rows, as far as they can be read.

For databases that break off: rosbags asks for their index, which a cut file no longer has.
"""

from __future__ import annotations

import os
import sqlite3
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path
from urllib.parse import quote

from bayesmap.io.ros.record import Connection, OnDamage, Record
from bayesmap.io.ros.recording import Topic

MAGIC = b"SQLite format 3\0"
LANGUAGES = {"ros2msg": "msg", "ros2idl": "idl"}


def sqlite_records(path: str | os.PathLike[str], on_damage: OnDamage) -> Iterator[Connection | Record]:
    """Connections and messages in the order in which they were written.

    Args:
        path: the database.
        on_damage: is told what cannot be read.
    """
    # Immutable: a journal beside it is not replayed, so that nothing is ever written.
    where = f"file:{quote(str(Path(path).absolute()))}?mode=ro&immutable=1"
    try:
        with closing(sqlite3.connect(where, uri=True)) as database:
            database.text_factory = lambda text: text.decode(errors="replace")
            yield from _connections(database)
            for number, received_ns, data in database.execute(
                "SELECT topic_id, timestamp, data FROM messages NOT INDEXED ORDER BY id"
            ):
                if isinstance(number, int) and isinstance(received_ns, int) and isinstance(data, bytes):
                    yield Record(number, received_ns, data)
                else:
                    on_damage("a row of the table of messages is damaged")
    except (sqlite3.Error, OverflowError, ValueError) as error:
        on_damage(f"SQLite says: {error}")


def _connections(database: sqlite3.Connection) -> Iterator[Connection]:
    definitions: dict[str, tuple[str, str]] = {}
    if database.execute("SELECT 1 FROM sqlite_master WHERE name = 'message_definitions'").fetchone():
        for name, encoding, text in database.execute(
            "SELECT topic_type, encoding, encoded_message_definition FROM message_definitions"
        ):
            definitions[str(name)] = (str(text), LANGUAGES.get(encoding, ""))
    for number, name, type_name, encoding in database.execute(
        "SELECT id, name, type, serialization_format FROM topics ORDER BY id"
    ):
        text, language = definitions.get(str(type_name), ("", "msg"))
        yield Connection(int(number), Topic(str(name), str(type_name), 0, text, language, str(encoding)))
