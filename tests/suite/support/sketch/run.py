# Runs the MicroPython sketch under Python with stand-ins for its modules: lines of the standard input are a time in ms, and what arrives then.
import sys
import time
import types

now, arrived, off, script = 0, "", {}, sys.argv[1]
lines = [line.split(maxsplit=1) for line in sys.stdin.read().splitlines()]


class Bus:
    def __init__(self, *_, **__):
        pass

    def writeto_mem(self, board, register, data):
        if len(data) == 4:
            off[(register - 6) // 4] = data[2] | data[3] << 8


class Poll:
    def register(self, *_):
        pass

    def poll(self, _):
        return bool(arrived)


class Input:
    def read(self, _):
        global arrived
        letter, arrived = arrived[0], arrived[1:]
        return letter


def sleep_ms(ms):
    global now, arrived
    if lines and now >= int(lines[0][0]):
        if told[0]:
            print("@%d %s" % (now, " ".join(str(off[i]) for i in sorted(off))))
            lines.pop(0)
        elif len(lines[0]) > 1:
            arrived = lines[0][1] + "\n"
        told[0] = not told[0]
        if not lines:
            sys.exit(0)
        return
    now += 1


told = [False]
time.ticks_ms = lambda: now
time.ticks_add = lambda a, b: a + b
time.ticks_diff = lambda a, b: a - b
time.sleep_ms = sleep_ms
modules = {
    "machine": {"I2C": Bus, "Pin": lambda *_: None},
    "uselect": {"poll": Poll, "POLLIN": 1},
    "micropython": {"const": lambda value: value},
}
for name, members in modules.items():
    sys.modules[name] = types.ModuleType(name)
    sys.modules[name].__dict__.update(members)
sys.stdin = Input()
exec(compile(open(script).read(), script, "exec"), {"__name__": "__main__"})
