"""Import every module of both packages and every file of tests as Windows would: without what POSIX alone has.

python tests/without_posix.py [FILE...]      prints a line for each that fails, and ends with 1 if one does; so for FILE

Importing a file of tests runs its decorators and lists of parameters, which is where a name that is not there stops
the collection. The libraries that these files import are imported before: they look at the system by themselves.
"""

import ast
import importlib
import os
import signal
import sys
import warnings
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from pkgutil import walk_packages

import pytest

HOME = Path(__file__).parent
THESIS = HOME.parent / "reproduction"  # the package of its figures, which need not be installed
# By the stubs of typeshed: functions that Windows lacks, beginnings of the names of constants, and what it does have.
OS_FUNCTIONS = """
    chown chroot confstr copy_file_range ctermid eventfd fchdir fchown fdatasync fork forkpty fstatvfs fwalk getegid
    geteuid getgid getgrouplist getgroups getloadavg getpgid getpgrp getpriority getrandom getresgid getresuid getsid
    getuid getxattr initgroups killpg lchown listxattr lockf major makedev memfd_create minor mkfifo mknod nice openpty
    pathconf pidfd_open pipe2 posix_fadvise posix_fallocate posix_spawn pread preadv pwrite pwritev readv
    register_at_fork removexattr sched_getaffinity sched_setaffinity sched_yield sendfile setegid seteuid setgid
    setgroups setpgid setpgrp setpriority setregid setreuid setsid setuid setxattr splice statvfs sync sysconf tcgetpgrp
    tcsetpgrp ttyname uname unshare wait wait3 wait4 waitid writev
"""
OS_CONSTANTS = "CLD_ CLONE_ EFD_ EX_ MFD_ POSIX_ PRIO_ RTLD_ RWF_ SCHED_ ST_ XATTR_ WCONT WEXIT WIF WNO WUN"
OS_FLAGS_THERE = "O_APPEND O_BINARY O_CREAT O_EXCL O_RDONLY O_RDWR O_TEXT O_TRUNC O_WRONLY"
SIGNALS_THERE = "SIGABRT SIGFPE SIGILL SIGINT SIGSEGV SIGTERM SIG_DFL SIG_IGN"
SIGNAL_FUNCTIONS = """
    alarm getitimer pause pthread_kill pthread_sigmask setitimer siginterrupt sigpending sigtimedwait sigwait
    sigwaitinfo
"""
MODULES = "crypt fcntl grp nis posix pty pwd readline resource spwd syslog termios tty"


def main() -> int:
    """Return 1 if a module cannot be imported, else 0."""
    files = [*sorted(HOME.rglob("*.py")), *sorted((THESIS / "tests").rglob("*.py")), *map(Path, sys.argv[1:])]
    sys.path[:0] = [str(HOME), str(THESIS / "tests"), str(THESIS / "src")]
    warnings.simplefilter("ignore")
    for name in sorted(set().union(*map(libraries, files + packaged()))):
        attempt(importlib.import_module, name)
    hide()
    failed = {name: attempt(importlib.import_module, name) for name in modules()}
    failed |= {str(path): attempt(imported, path) for path in files if is_test(path)}
    for name, error in failed.items():
        if error is not None:
            sys.stdout.write(f"{name}: {type(error).__name__}: {error}\n")
    return int(any(failed.values()))


def hide() -> None:
    """Take away what Windows does not have."""
    for name in dir(os):
        flag = name.startswith("O_") and name not in OS_FLAGS_THERE.split()
        if flag or name in OS_FUNCTIONS.split() or name.startswith(tuple(OS_CONSTANTS.split())):
            delattr(os, name)
    for name in dir(signal):
        number = name.startswith(("SIG", "ITIMER")) and name.isupper() and name not in SIGNALS_THERE.split()
        if number or name in SIGNAL_FUNCTIONS.split():
            delattr(signal, name)
    sys.modules |= dict.fromkeys(MODULES.split())  # None: an import fails


def packaged() -> list[Path]:
    """Return the files of both packages."""
    import roughcontact

    return sorted([*Path(roughcontact.__file__).parent.rglob("*.py"), *(THESIS / "src").rglob("*.py")])


def modules() -> list[str]:
    """Return the names of all modules of both packages, but for the one that starts the command."""
    import roughcontact
    import roughcontact_thesis

    packages = (roughcontact, roughcontact_thesis)
    found = [each.name for one in packages for each in walk_packages(one.__path__, f"{one.__name__}.")]
    return [name for name in found if not name.endswith("__main__")]


def libraries(path: Path) -> set[str]:
    """Return what a file asks for as it is imported, outside its functions, that is neither ours nor POSIX alone."""
    found = set()
    nodes: list[ast.AST] = list(ast.parse(path.read_text(encoding="utf-8")).body)
    for node in nodes:
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module:
            found.add(node.module)
        elif isinstance(node, ast.Call) and getattr(node.func, "attr", "") == "importorskip":
            found.add(ast.literal_eval(node.args[0]))
        elif not isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda):
            nodes.extend(ast.iter_child_nodes(node))
    here = {each.stem for folder in (HOME, THESIS / "tests") for each in folder.iterdir()}
    here |= {"roughcontact", "roughcontact_thesis", *MODULES.split()}
    return {name for name in found if name.split(".")[0] not in here}


def is_test(path: Path) -> bool:
    """Whether pytest imports a file by itself."""
    return path.name.startswith("test_") or path.name == "conftest.py"


def imported(path: Path) -> None:
    """Import a file of tests by its path, under a name of its own."""
    name = "_".join(path.with_suffix("").parts)
    spec = spec_from_file_location(name, path)
    sys.modules[name] = module = module_from_spec(spec)
    spec.loader.exec_module(module)


def attempt(work, name):
    """Return the error of importing something, if there is one; a file that skips itself has none."""
    try:
        work(name)
    except pytest.skip.Exception:
        return None
    except Exception as error:
        return error
    return None


if __name__ == "__main__":
    sys.exit(main())
