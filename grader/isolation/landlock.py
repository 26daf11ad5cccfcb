"""Landlock: a Linux process restricts its files, TCP and signals; it cannot be undone.

Read Linux's ``Documentation/userspace-api/landlock.rst``. Each version of the interface (ABI) knows
more rights; what this one does not know stays allowed, and the version is told.
"""

import ctypes
import os
import struct
import sys
from collections.abc import Iterable, Iterator
from pathlib import Path

CREATE_RULESET, ADD_RULE, RESTRICT_SELF = 444, 445, 446  # the same numbers on every processor
VERSION = 1  # flag of CREATE_RULESET: only ask which ABI there is
PATH_BENEATH = 1
NO_NEW_PRIVILEGES = 38

WRITE_FILE, READ_FILE, READ_DIR, REMOVE_DIR, REMOVE_FILE = (1 << bit for bit in range(1, 6))
MAKE_DIR, MAKE_FILE, TRUNCATE = 1 << 7, 1 << 8, 1 << 14
TREE = READ_FILE | READ_DIR
FOLDER = TREE | WRITE_FILE | REMOVE_DIR | REMOVE_FILE | MAKE_DIR | MAKE_FILE | TRUNCATE
DEVICE = READ_FILE | WRITE_FILE

FILE_RIGHTS = {1: 13, 2: 14, 3: 15, 5: 16}  # first ABI -> how many rights on files it knows
NETWORK_ABI, BIND_AND_CONNECT = 4, 0b11
SCOPE_ABI, SOCKETS_AND_SIGNALS = 6, 0b11

LIBRARIES = ("/lib", "/lib64", "/usr/lib", "/usr/lib64", "/nix/store", "/etc/ld.so.cache")
SOURCES = ("/dev/zero", "/dev/random", "/dev/urandom")
PACKAGES = {"site-packages", "dist-packages"}  # inside Python's library, but not all of it ours


def find_abi_version() -> int:
    """Which version this system has; 0 is none."""
    if not sys.platform.startswith("linux"):
        return 0
    found = int(ctypes.CDLL(None).syscall(CREATE_RULESET, None, ctypes.c_size_t(0), VERSION))
    return max(found, 0)


def restrict_file_access(
    *, readable: Iterable[Path], folder: Path, hidden: Path, newest: int | None = None
) -> int:
    """Let this process only read Python's files and ``readable``, and write only ``folder``.

    Args:
        readable: files and folders besides Python's own library and the system's.
        folder: where it may make, change and remove files.
        hidden: a folder that stays unreadable even inside one of the libraries.
        newest: the ABI to use at most, as on an older kernel; None uses all there is.

    Returns:
        The ABI in force; 0 if there is none.
    """
    version = find_abi_version() if newest is None else min(find_abi_version(), newest)
    if not version:
        return 0
    call = ctypes.CDLL(None, use_errno=True).syscall
    known = (1 << max(count for first, count in FILE_RIGHTS.items() if first <= version)) - 1
    words = [known]
    if version >= NETWORK_ABI:
        words.append(BIND_AND_CONNECT)
    if version >= SCOPE_ABI:
        words.append(SOCKETS_AND_SIGNALS)
    asked = struct.pack(f"={len(words)}Q", *words)
    rules = int(call(CREATE_RULESET, asked, ctypes.c_size_t(len(asked)), 0))
    if rules < 0:
        return 0
    try:
        for path, rights in _list_permissions(readable, folder, hidden):
            _allow_path(call, rules, path, rights & known)
        ctypes.CDLL(None).prctl(NO_NEW_PRIVILEGES, 1, 0, 0, 0)
        return version if call(RESTRICT_SELF, rules, 0) == 0 else 0
    finally:
        os.close(rules)


def _list_permissions(
    readable: Iterable[Path], folder: Path, hidden: Path
) -> Iterator[tuple[Path, int]]:
    """Each path, with the operations that are allowed on it and below it."""
    yield folder, FOLDER
    yield Path(os.devnull), DEVICE
    for path in readable:
        yield path, TREE
    for name in (*LIBRARIES, *SOURCES):
        for part in _exclude_folder(Path(name), hidden):
            yield part, TREE
    for shared in (Path(sys.base_prefix) / "lib").glob("*.so*"):
        yield shared, READ_FILE
    for library in map(Path, sys.path):
        yield library, READ_DIR  # an import looks through the folder first
        if library.is_dir():
            for part in library.iterdir():
                if part.name not in PACKAGES:
                    yield part, TREE


def _exclude_folder(tree: Path, hidden: Path) -> Iterator[Path]:
    """A tree, or all of its parts but one."""
    whole = tree.resolve()
    if not hidden.is_relative_to(whole):
        yield tree
    elif whole != hidden and whole.is_dir():
        for part in whole.iterdir():
            yield from _exclude_folder(part, hidden)


def _allow_path(call: "ctypes._NamedFuncPointer", rules: int, path: Path, rights: int) -> None:
    """Allow one path; one that is not there needs no permission."""
    try:
        opened = os.open(path, os.O_PATH | os.O_CLOEXEC)
    except OSError:
        return
    try:
        if not path.is_dir():
            rights &= READ_FILE | WRITE_FILE | TRUNCATE
        rule = struct.pack("=Qi", rights, opened)
        call(ADD_RULE, rules, PATH_BENEATH, rule, 0)
    finally:
        os.close(opened)
