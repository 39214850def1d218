# SPDX-License-Identifier: LGPL-2.1-or-later
"""Receivers and senders of the documentation, on the loopback network."""
import re
import time

from support import PIPELINES, SLOW, free_port, open_udp_ports, start, stop

# A connection that ends loses the last frames, as long as the latency, and the clips are short [ms].
LATENCY = 40


def is_receiver(line):
    return re.search(r"\b(srtsrc|udpsrc)\b", line) is not None


def is_sender(line):
    return re.search(r"\b(srtsink|udpsink)\b", line) is not None


def wait_for_port(port, process):
    """Waits until a UDP port is open, or the process that is to open it has ended."""
    deadline = time.monotonic() + 30 * SLOW
    while process.poll() is None and time.monotonic() < deadline:
        if port in open_udp_ports():
            return
        time.sleep(0.02)


class Loopback:
    """A launch line with other ports and without other hosts. `peer` is the address for a script at
    the other end. `waits` states whether this line opens `port`, to which the other end connects."""

    def __init__(self, line):
        line = re.sub(r"\blatency=\d+", f"latency={LATENCY}", line)
        srt = re.search(r"\buri=srt://([^: ]*):\d+", line)
        if srt:
            self.waits, self.port = not srt[1], free_port()
            host = "" if self.waits else "127.0.0.1"
            self.line = line.replace(srt[0], f"uri=srt://{host}:{self.port}")
            self.peer = f"srt://{'127.0.0.1' if self.waits else ''}:{self.port}"
            return
        self.waits = is_receiver(line)
        old, first = min(map(int, re.findall(r"\bport=(\d+)", line))), free_port(4)
        line = re.sub(r"\bport=(\d+)", lambda found: f"port={int(found[1]) - old + first}", line)
        self.line = re.sub(r"\bhost=\S+", "host=127.0.0.1", line)
        self.peer = f"rtp://{'127.0.0.1' if self.waits else ''}:{first}"
        self.port = first + 3


def passphrase_of(line):
    found = re.search(r"\bpassphrase=(\S+)", line)
    return ["--passphrase", found[1]] if found else []


# Ends after the first map. A connection that ends before leads to an empty file.
SINK = "identity eos-after=2 ! filesink location=received.raw buffer-mode=unbuffered"


def exchange(receiver, sender, port, receiver_waits, folder):
    """Runs a receiver, and a sender until the receiver ends: clips are short, and are sent again.
    Returns whether a map was received, and the outputs."""
    (folder / "received.raw").unlink(missing_ok=True)
    deadline = time.monotonic() + 120 * SLOW
    sent = None if receiver_waits else start(sender, folder)
    if sent:
        wait_for_port(port, sent)
    process, log = start(receiver, folder), ""
    try:
        if receiver_waits:
            wait_for_port(port, process)
        while process.poll() is None and time.monotonic() < deadline:
            sent = sent or start(sender, folder)
            while process.poll() is None and sent.poll() is None and time.monotonic() < deadline:
                time.sleep(0.05)
            stop(sent)
            log, sent = "\n".join(sent.communicate()), None
    finally:
        stop(process)
        output, errors = process.communicate()
    maps = sum(file.stat().st_size for file in folder.glob("received.raw"))
    return process.returncode == 0 and maps > 0, f"{output}{errors}\nlast sender:\n{log}"


# A connection of a short clip can end before the first frame is received, more often with sanitizers or beside
# other load.
ATTEMPTS = 6 if SLOW == 1 else 10


def attempts(attempt):
    received, log = attempt()
    for _ in range(1, ATTEMPTS):
        if received:
            break
        received, log = attempt()
    return received, log


def receive(line, folder):
    """Runs the launch line of a receiver, which shows maps."""
    here = Loopback(line.replace("fakesink sync=false", SINK))
    sender = [PIPELINES / "network-sender.sh", "left.mp4", "right.mp4", "--to", here.peer,
              "--latency", LATENCY, *passphrase_of(line)]
    return attempts(lambda: exchange(["bash", "-c", here.line], sender, here.port, here.waits,
                                        folder))


def send(line, folder):
    """Runs the launch line of a sender."""
    here = Loopback(line)
    receiver = [PIPELINES / "from-network.sh", here.peer, "--sink", SINK, "--latency", LATENCY,
                *passphrase_of(line)]
    return attempts(lambda: exchange(receiver, ["bash", "-c", here.line], here.port,
                                        not here.waits, folder))
