# SPDX-License-Identifier: LGPL-2.1-or-later
"""The results of mtstereo-benchmark and mtstereo-benchmark-element as Markdown."""
import math

DEFAULT = "semi-dense"
RIVALS = ("sgbm-3way", "bm")
MOST_SPREAD = 0.05
LEAST_PROCESSORS = 0.95  # of consecutive frames, with any number of threads


def table(head, rows, texts=1):
    """A table; the first columns are text and the others are figures."""
    lines = [head, ["---"] * texts + ["---:"] * (len(head) - texts), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def ratio(a, b):
    return "-" if a is None or b is None else f"{a / b:.2f}"


def percent(share):
    return "-" if share is None else f"{share * 100:.1f}"


def machine(result, element_result):
    context = result.context
    caches = ", ".join(f"L{cache['level']} {cache['type'].lower()} {cache['size'] // 1024} KiB"
                       + (f" (for {cache['num_sharing']} CPUs)" if cache["num_sharing"] > 1 else "")
                       for cache in context["caches"])
    lines = [f"Processor: {context['processor']}, {context['num_cpus']} CPUs of "
             f"{context['mhz_per_cpu']} MHz; caches: {caches or 'unknown'}.",
             f"Measured on {context['date'][:10]} with mtstereo {context['mtstereo']}, OpenCV "
             f"{context['opencv']}"
             + (f", {element_result.context['gstreamer']}" if element_result else "") + ".",
             "All figures are medians of the repetitions; `spread` is their standard deviation "
             "divided by their mean."]
    return "\n".join(lines)


class FrameTimes:
    """Whole frames, by frame, method and number of threads."""

    def __init__(self, result):
        self.by_key = {}
        for one in result.of("frame"):
            threads = int(one.part(3).removeprefix("threads:"))
            self.by_key[one.part(1), one.part(2), threads] = one

    def frames(self):
        return list(dict.fromkeys(frame for frame, _, _ in self.by_key))

    def milliseconds(self, *key):
        return self.by_key[key].milliseconds if key in self.by_key else None

    def row(self, frame, method, threads):
        one = self.by_key[frame, method, threads]
        time = one.milliseconds
        others = [self.milliseconds(frame, other, threads) for other in (DEFAULT, *RIVALS)]
        return [f"`{method}`", str(threads), f"{time:.1f}", percent(one.spread),
                f"{one.value('s/MP'):.3f}", f"{1e3 / time:.1f}", percent(one.value("density")),
                ratio(one.processor_milliseconds, time),
                ratio(self.milliseconds(frame, method, 1), time),
                *(ratio(time, other) for other in others)]

    def table(self, frame):
        head = ["method", "threads", "ms", "spread %", "s/MP", "frames/s", "density %", "CPUs",
                "speedup", *(f"time / `{other}`" for other in (DEFAULT, *RIVALS))]
        return table(head, [self.row(*key) for key in self.by_key if key[0] == frame])


def frames(result):
    times = FrameTimes(result)
    if not times.by_key:
        return ""
    parts = ["### Whole frames",
             "`speedup` is relative to one thread; the ratios compare the same frame with the same "
             "number of threads."]
    parts += [f"`{frame}`:\n\n{times.table(frame)}" for frame in times.frames()]
    return "\n\n".join(parts)


def stages(result):
    measured = result.of("stage")
    if not measured:
        return ""
    rows = [[f"`{one.part(3)}`", f"`{one.part(2)}`", f"{one.value('ns/px'):.2f}",
             f"{one.milliseconds:.2f}", percent(one.spread)] for one in measured]
    default = [one for one in measured if one.part(2) == DEFAULT]
    if default:
        rows.append([f"all of `{DEFAULT}`", "", f"{sum(one.value('ns/px') for one in default):.2f}",
                     f"{sum(one.milliseconds for one in default):.2f}", ""])
    return (f"### Stages\n\n`{measured[0].part(1)}`, 1 thread.\n\n"
            + table(["stage", "of", "ns/px", "ms", "spread %"], rows, texts=2))


def targets(result):
    measured = result.of("target")
    if not measured:
        return ""
    times = {one.part(2): one.milliseconds for one in measured}
    rows = [[one.part(2), f"{one.milliseconds:.1f}", percent(one.spread),
             ratio(one.milliseconds, times.get("AVX2")),
             ratio(one.milliseconds, measured[0].milliseconds)] for one in measured]
    head = ["target", "ms", "spread %", "time / AVX2", f"time / {measured[0].part(2)}"]
    return (f"### SIMD targets\n\n`{measured[0].part(1)}`, `{DEFAULT}`, 1 thread.\n\n"
            + table(head, rows))


def exponent(points):
    """The slope of a line fitted to the logarithms: 1 = proportional."""
    logs = [(math.log(x), math.log(y)) for x, y in points]
    middle = [sum(values) / len(logs) for values in zip(*logs)]
    above = sum((x - middle[0]) * (y - middle[1]) for x, y in logs)
    return above / sum((x - middle[0]) ** 2 for x, _ in logs)


def growth_points(result, what):
    """Pairs of pixels [MP] or disparities, and milliseconds."""
    scale = 1e-6 if what == "pixels" else 1
    return sorted((one.value(what) * scale, one.milliseconds)
                  for one in result.of("scaling") if one.part(1) == what)


def growth(result):
    parts = ["### Growth with pixels and disparities",
             "Rendered street, `semi-dense`, 1 thread. The exponent is the slope of a line fitted "
             "to the logarithms: 1 is proportional growth, less is better."]
    for what, head in (("pixels", "frame"), ("disparities", "disparities")):
        points = growth_points(result, what)
        if len({x for x, _ in points}) < 2:
            continue
        measured = [one for one in result.of("scaling") if one.part(1) == what]
        rows = [[one.part(2), f"{one.milliseconds:.1f}", percent(one.spread),
                 f"{one.milliseconds * 1e6 / one.value('pixels'):.1f}",
                 f"{one.milliseconds * 1e6 / one.value('pixels') / one.value('disparities'):.3f}"]
                for one in measured]
        parts.append(table([head, "ms", "spread %", "ns/px", "ns/px/disparity"], rows))
        parts.append(f"Exponent over {what}: {exponent(points):.2f}.")
    return "\n\n".join(parts) if len(parts) > 2 else ""


def memory(result):
    measured = result.of("memory")
    if not measured:
        return ""
    rows = []
    for one in measured:
        size = one.part(1).removeprefix("first-frame-")
        rows.append([size, f"`{one.settings().replace('/', ' ')}`" if one.settings() else
                     "defaults", f"{one.value('peak_MiB'):.1f}", f"{one.milliseconds:.1f}"])
    return ("### Memory\n\nPreset default, mode semi-dense and 1 thread unless stated otherwise; "
            "`cost-volume=full` is the exact cost volume.\n\n"
            + table(["frame", "settings", "peak MiB", "first frame ms"], rows, texts=2))


def element(result):
    measured = result.of("element")
    if not measured:
        return ""
    rows = [[one.part(1), one.part(2).removeprefix("threads:"), f"{one.value('library_ms'):.2f}",
             f"{one.milliseconds:.2f}", f"{one.value('overhead_percent'):.2f}"]
            for one in measured]
    return ("### Element\n\nTime of a frame in a pipeline from memory to a fakesink, and of "
            "`Matcher::compute` on the same frames.\n\n"
            + table(["frame", "threads", "library ms", "element ms", "overhead %"], rows))


def doubts(result):
    """The signs of other load on the machine, which makes a result unfit for publication."""
    doubtful = []
    for one in result.measurements:
        if one.spread is not None and one.spread > MOST_SPREAD:
            doubtful.append(f"{one.name}: spread {percent(one.spread)} %")
    for one in FrameTimes(result).by_key.values():
        processors = one.processor_milliseconds / one.milliseconds
        if processors < LEAST_PROCESSORS:
            doubtful.append(f"{one.name}: {processors:.2f} CPUs, other programs used the rest")
    return doubtful
