# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the tests that kill processes share."""
import pathlib


def is_running(pid):
    try:
        state = pathlib.Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0]
    except (FileNotFoundError, ProcessLookupError):
        return False
    return state != "Z"
