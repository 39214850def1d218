# SPDX-License-Identifier: LGPL-2.1-or-later
"""Paths through a network with delay and loss, as relays between UDP ports of the loopback."""
import heapq
import itertools
import random
import selectors
import socket
import threading
import time


class Direction:
    """One direction of a path: packets leave in the order of their delayed times."""

    def __init__(self, delay, loss, seed):
        self.delay, self.loss, self.random = delay, loss, random.Random(seed)
        self.sent = self.lost = 0

    def due(self):
        """When a packet that arrives now leaves, or None if it is lost."""
        self.sent += 1
        if self.random.random() < self.loss:
            self.lost += 1
            return None
        return time.monotonic() + self.random.uniform(*self.delay)


class Network:
    """Relays packets to and from ports, in one thread. `delay` is a range [s] out of which each
    packet gets its delay, `loss` the share of the packets that are lost."""

    def __init__(self):
        self.selector = selectors.DefaultSelector()
        self.waiting, self.order = [], itertools.count()
        self.directions, self.running = [], True
        self.thread = threading.Thread(target=self._run, daemon=True)

    def add_path(self, target, delay=(0.0, 0.0), loss=0.0, seed=1, port=0):
        """The port from which packets are relayed to the port `target`, and back to their sender."""
        outer = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        inner = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        for each in (outer, inner):
            each.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4_000_000)
            each.setblocking(False)
        outer.bind(("127.0.0.1", port))
        inner.bind(("127.0.0.1", 0))
        there, back = Direction(delay, loss, seed), Direction(delay, loss, seed + 1000)
        self.directions += [there, back]
        peer = {}
        self.selector.register(outer, selectors.EVENT_READ,
                               (there, inner, lambda sender: ("127.0.0.1", target), peer))
        self.selector.register(inner, selectors.EVENT_READ,
                               (back, outer, lambda sender: peer.get("address"), {}))
        return outer.getsockname()[1]

    def share_lost(self):
        sent = sum(each.sent for each in self.directions)
        return sum(each.lost for each in self.directions) / max(sent, 1)

    def __enter__(self):
        self.thread.start()
        return self

    def __exit__(self, *_):
        self.running = False
        self.thread.join()
        for key in list(self.selector.get_map().values()):
            key.fileobj.close()
        self.selector.close()

    def _run(self):
        while self.running:
            wait = min(0.1, self.waiting[0][0] - time.monotonic()) if self.waiting else 0.1
            for key, _ in self.selector.select(max(wait, 0)):
                self._receive(key.fileobj, *key.data)
            while self.waiting and self.waiting[0][0] <= time.monotonic():
                _, _, output, data, address = heapq.heappop(self.waiting)
                try:
                    output.sendto(data, address)
                except OSError:
                    pass  # nobody listens, or the buffer is full: the packet is lost

    def _receive(self, source, direction, output, target_of, peer):
        while True:
            try:
                data, sender = source.recvfrom(65536)
            except BlockingIOError:
                return
            except OSError:
                continue  # an earlier packet was refused
            peer["address"] = sender
            address, due = target_of(sender), direction.due()
            if address is not None and due is not None:
                heapq.heappush(self.waiting, (due, next(self.order), output, data, address))
