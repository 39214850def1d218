# SPDX-License-Identifier: LGPL-2.1-or-later
"""Takes single frames out of a Matroska file, as a camera or a network loses them."""

SEGMENT, CLUSTER = 0x18538067, 0x1F43B675
SIMPLE_BLOCK, BLOCK_GROUP, VOID = 0xA3, 0xA0, 0xEC


def number(data, at, keep_marker):
    """A variable-length number: its value and its length in bytes."""
    length = 9 - data[at].bit_length()
    value = int.from_bytes(data[at:at + length], "big")
    if not keep_marker:
        value &= (1 << 7 * length) - 1
        if value == (1 << 7 * length) - 1:
            value = None  # "unknown": up to the end of what it is in
    return value, length


def elements(data, start, end):
    """(id, position, start of content, end of content) of each element, one after the other."""
    at = start
    while at < end:
        name, name_length = number(data, at, True)
        size, size_length = number(data, at + name_length, False)
        content = at + name_length + size_length
        stop = end if size is None else content + size
        yield name, at, content, stop
        at = stop


def block_positions(data):
    for name, _, start, end in elements(data, 0, len(data)):
        if name != SEGMENT:
            continue
        for inner, _, cluster_start, cluster_end in elements(data, start, end):
            if inner != CLUSTER:
                continue
            for block, position, _, _ in elements(data, cluster_start, cluster_end):
                if block in (SIMPLE_BLOCK, BLOCK_GROUP):
                    yield position


def lose_frames(file, target, lost):
    """Copies a file without the frames numbered in `lost`; the others keep their times."""
    data = bytearray(file.read_bytes())
    positions = list(block_positions(data))
    for n in lost:
        data[positions[n]] = VOID  # same length, and every reader skips it
    target.write_bytes(data)
    return len(positions)
