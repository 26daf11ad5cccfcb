"""Seccomp: a Linux process gives up system calls, for good, unprivileged.

Gone are new processes and programs, sockets, signals to others (by ``kill`` or by an owner of a
file, ``F_SETOWN``), a look into others, a change of anybody's rights, and the ways around Landlock,
which knows no ``chmod``. Threads stay.
"""

import ctypes
import errno
import os
import platform
import struct
import sys
from collections.abc import Iterator
from dataclasses import dataclass

NO_NEW_PRIVILEGES, SET_SECCOMP, FILTER = 38, 22, 2
CLONE_THREAD = 0x10000
CAPABILITY_VERSION = 0x20080522
ANOTHER_TABLE = 0x40000000  # from here on x86-64 has the numbers of its other interface, x32

LOAD, EQUAL, AT_LEAST, ANY_BIT, RETURN = 0x20, 0x15, 0x35, 0x45, 0x06
NUMBER, ARCHITECTURE = 0, 4  # [bytes] into what the filter is shown
FIRST_ARGUMENT, SECOND_ARGUMENT = 16, 24  # [bytes] the same
ALLOW, REFUSE, ABSENT = 0x7FFF0000, 0x50000 | errno.EPERM, 0x50000 | errno.ENOSYS

# The kernel signals a file's owner when the file is ready, and any process can be made its owner.
# Landlock stops that from ABI 6 (Linux 6.12) on only.
FCNTL_OWNER = (8, 10, 15)  # F_SETOWN F_SETSIG F_SETOWN_EX
IOCTL_OWNER = (0x8901, 0x8902)  # FIOSETOWN SIOCSPGRP


@dataclass(frozen=True)
class SyscallTable:
    """A processor's numbers of system calls.

    Args:
        architecture: how the filter is told which table a call is of.
        clone, clone3, capset, fcntl, ioctl: their numbers.
        own: calls that are allowed on oneself only, whose first argument says whom they mean.
        refused: calls that are not allowed at all.
    """

    architecture: int
    clone: int
    clone3: int
    capset: int
    fcntl: int
    ioctl: int
    own: tuple[int, ...]
    refused: tuple[int, ...]


# In the order: kill tgkill prlimit64 sched_setaffinity sched_setparam sched_setscheduler
# sched_setattr; then fork vfork execve execveat socket
# setsid setpgid tkill rt_sigqueueinfo rt_tgsigqueueinfo pidfd_send_signal ptrace process_vm_readv
# process_vm_writev io_uring_setup unshare setns keyctl bpf perf_event_open shmget msgget semget
# mq_open truncate chmod fchmod fchmodat fchmodat2 chown fchown lchown fchownat setxattr lsetxattr
# fsetxattr utime utimes utimensat setpriority ioprio_set pidfd_getfd; memory, semaphores and
# messages that programs of one user share: shmat shmctl semop semctl msgsnd msgrcv msgctl
# semtimedop. (ARM has no fork, vfork,
# chmod, chown, lchown, utime, utimes.)
TABLES = {
    "x86_64": SyscallTable(
        0xC000003E, 56, 435, 126, 72, 16, (62, 234, 302, 203, 142, 144, 314),
        (57, 58, 59, 322, 41, 112, 109, 200, 129, 297, 424, 101, 310, 311, 425, 272, 308, 250,
         321, 298, 29, 68, 64, 240, 76, 90, 91, 268, 452, 92, 93, 94, 260, 188, 189, 190, 132,
         235, 280, 141, 251, 438, 30, 31, 65, 66, 69, 70, 71, 220),
    ),
    "aarch64": SyscallTable(
        0xC00000B7, 220, 435, 91, 25, 29, (129, 131, 261, 122, 118, 119, 274),
        (221, 281, 198, 157, 154, 130, 138, 240, 424, 117, 270, 271, 425, 97, 268, 219, 280, 241,
         194, 186, 190, 180, 45, 52, 53, 452, 55, 54, 5, 6, 7, 88, 140, 30, 438, 196, 195, 193, 191,
         189, 188, 187, 192),
    ),
}  # fmt: skip


def forbid_syscalls() -> bool:
    """Forbid the system calls; False where this system or processor cannot."""
    table = TABLES.get(platform.machine())
    if table is None or not sys.platform.startswith("linux") or sys.maxsize < 2**32:
        return False
    system = ctypes.CDLL(None)
    header = struct.pack("=Ii", CAPABILITY_VERSION, 0)
    system.syscall(table.capset, header, struct.pack("=6I", *[0] * 6))  # root is nobody special
    if system.prctl(NO_NEW_PRIVILEGES, 1, 0, 0, 0) != 0:
        return False
    steps = b"".join(struct.pack("=HBBI", *step) for step in _make_filter(table))
    kept = ctypes.create_string_buffer(steps)
    program = struct.pack("@HP", len(steps) // 8, ctypes.addressof(kept))
    return bool(system.prctl(SET_SECCOMP, FILTER, program, 0, 0) == 0)


def _make_filter(table: SyscallTable) -> Iterator[tuple[int, int, int, int]]:
    """The filter: code, steps to skip if so, steps to skip if not, number."""
    yield LOAD, 0, 0, ARCHITECTURE
    yield EQUAL, 1, 0, table.architecture
    yield RETURN, 0, 0, REFUSE
    yield LOAD, 0, 0, NUMBER
    yield AT_LEAST, 0, 1, ANOTHER_TABLE
    yield RETURN, 0, 0, REFUSE
    for number in table.refused:
        yield EQUAL, 0, 1, number
        yield RETURN, 0, 0, REFUSE
    yield EQUAL, 0, 1, table.clone3  # its flags lie in memory, out of a filter's sight; as if the
    yield RETURN, 0, 0, ABSENT  # system were older, a thread is then made by clone
    yield EQUAL, 0, 4, table.clone
    yield LOAD, 0, 0, FIRST_ARGUMENT
    yield ANY_BIT, 1, 0, CLONE_THREAD
    yield RETURN, 0, 0, REFUSE
    yield RETURN, 0, 0, ALLOW
    for number in table.own:
        yield EQUAL, 0, 5, number
        yield LOAD, 0, 0, FIRST_ARGUMENT
        yield EQUAL, 2, 0, os.getpid()
        yield EQUAL, 1, 0, 0
        yield RETURN, 0, 0, REFUSE
        yield RETURN, 0, 0, ALLOW
    for number, commands in ((table.fcntl, FCNTL_OWNER), (table.ioctl, IOCTL_OWNER)):
        yield EQUAL, 0, len(commands) + 3, number
        yield LOAD, 0, 0, SECOND_ARGUMENT
        for left in range(len(commands), 0, -1):
            yield EQUAL, left, 0, commands[-left]
        yield RETURN, 0, 0, ALLOW
        yield RETURN, 0, 0, REFUSE
    yield RETURN, 0, 0, ALLOW
