"""Machine code outside Numba: compiled by Numba, loaded and linked by LLVM alone."""

import ctypes
import hashlib
import json
import re
import sys
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from typing import Any

import llvmlite
import llvmlite.binding as llvm

OF_NUMBA = ("NRT_", "numba_")  # prefixes of functions that only code that raises would call


@dataclass(frozen=True)
class ObjectCode:
    """An object file, and the symbols that are needed to call it.

    Args:
        symbol: the name of the function.
        needs: names of functions of the C library and of Python that it calls.
        content: the bytes of the file.
    """

    symbol: str
    needs: tuple[str, ...]
    content: bytes

    def to_bytes(self) -> bytes:
        """Serialize the object code for a file."""
        head = {"symbol": self.symbol, "needs": self.needs, "sha256": _compute_hash(self.content)}
        return json.dumps(head).encode() + b"\n" + self.content

    @classmethod
    def from_bytes(cls, written: bytes) -> "ObjectCode | None":
        """Read what ``to_bytes`` wrote; None if it is damaged."""
        head, _, content = written.partition(b"\n")
        try:
            fields = json.loads(head)
            code = cls(fields["symbol"], tuple(fields["needs"]), content)
            return code if fields["sha256"] == _compute_hash(content) else None
        except (ValueError, KeyError, TypeError):
            return None


def _compute_hash(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()


def identify_machine() -> str:
    """Llvmlite's version, system and processor, for which machine code is valid."""
    triple, processor = llvm.get_process_triple(), llvm.get_host_cpu_name()
    features = llvm.get_host_cpu_features().flatten()
    return f"{llvmlite.__version__}\n{triple}\n{processor}\n{features}"


def extract_code(made: Any) -> ObjectCode:  # noqa: ANN401 - Numba has no types
    """The object file of what Numba compiled, a ``numba.core.ccallback.CFunc``."""
    llvm.initialize_native_target()
    llvm.initialize_native_asmprinter()
    module = llvm.parse_assembly(made.inspect_llvm())
    symbol = next(one.name for one in module.functions if one.name.startswith("cfunc."))
    if stubs := "\n".join(_make_stubs(module)):
        module.link_in(llvm.parse_assembly(stubs))
    every = [*module.functions, *module.global_variables]
    named = [one.name for one in every if one.is_declaration]
    intrinsic = [found[1] for one in named if (found := re.match(r"llvm\.(\w+)\.f64", one))]
    needs = [one for one in named if not one.startswith("llvm.")]
    needs += [one for one in intrinsic if _find_symbol(one)]  # it may be a call, or an instruction
    return ObjectCode(symbol, tuple(needs), _make_target_machine().emit_object(module))


def _make_stubs(module: Any) -> Iterator[str]:  # noqa: ANN401 - llvmlite has no types
    """LLVM bodies for functions of Numba's library, which is missing when the code is loaded."""
    for one in module.functions:
        if one.is_declaration and one.name.startswith(OF_NUMBA):
            found = re.search(r"declare (.*?@\w+\(.*?\))", str(one))
            if found:
                yield f"define {found[1]} {{ unreachable }}"


def _make_target_machine() -> Any:  # noqa: ANN401 - llvmlite has no types
    """LLVM's target machine for this processor, with Numba's settings."""
    triple = llvm.get_process_triple()
    return llvm.Target.from_triple(triple).create_target_machine(
        cpu=llvm.get_host_cpu_name(),
        features=llvm.get_host_cpu_features().flatten(),
        opt=3,
        reloc="static" if triple.startswith("x86") else "default",
        codemodel="jitdefault",
        jit=True,
    )


def link_code(code: ObjectCode) -> tuple[int, object] | None:
    """Link object code: the function's address, and the objects that must outlive its calls.

    None if a symbol that it needs is missing: LLVM would end the whole process.
    """
    llvm.initialize_native_target()
    llvm.initialize_native_asmprinter()
    for name in code.needs:
        address = _find_symbol(name)
        if not address:
            return None
        llvm.add_symbol(name, address)
    engine = llvm.create_mcjit_compiler(llvm.parse_assembly(""), _make_target_machine())
    engine.add_object_file(llvm.ObjectFileRef.from_data(code.content))
    engine.finalize_object()
    address = engine.get_function_address(code.symbol)
    return (address, engine) if address else None


def _find_symbol(name: str) -> int | None:
    """The address of a function of Python or of the C library; None if there is none."""
    libraries = [ctypes.pythonapi]
    if sys.platform == "win32":
        libraries.append(ctypes.PyDLL("ucrtbase"))
    for library in libraries:
        with suppress(ValueError):
            return ctypes.addressof(ctypes.c_char.in_dll(library, name))
    return None
