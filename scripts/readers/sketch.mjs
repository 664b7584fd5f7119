// Runs a MicroPython sketch in MicroPython (WebAssembly) with stand-ins for its board: lines of the script are a time in ms, and what arrives then.
import { loadMicroPython } from './package/micropython.mjs';
import fs from 'node:fs';

const [sketch, script] = process.argv.slice(2).map((path) => fs.readFileSync(path, 'utf8'));
const python = await loadMicroPython({
  stdout: (line) => process.stdout.write(line + '\n'),
  linebuffer: true,
  heapsize: 4 * 1024 * 1024,
});
python.globals.set('script', script);
python.globals.set('sketch', sketch);
python.runPython(`
import sys as real

class Thing: pass
class Over(Exception): pass

board = Thing()
board.now, board.arrived, board.told, board.off = 0, "", False, {}
lines = [line.split(" ", 1) for line in script.strip().split("\\n")]

class Bus:
    def __init__(self, *_, **__): pass
    def writeto_mem(self, address, register, data):
        if len(data) == 4:
            board.off[(register - 6) // 4] = data[2] | data[3] << 8

class Poll:
    def register(self, *_): pass
    def poll(self, _): return bool(board.arrived)

class Input:
    def read(self, _):
        letter, board.arrived = board.arrived[0], board.arrived[1:]
        return letter

def sleep_ms(_):
    if board.now < int(lines[0][0]):
        board.now += 1
        return
    if board.told:
        print("@%d %s" % (board.now, " ".join(str(board.off[i]) for i in sorted(board.off))))
        lines.pop(0)
    elif len(lines[0]) > 1:
        board.arrived = lines[0][1] + "\\n"
    board.told = not board.told
    if not lines:
        raise Over()

def module(name, **members):
    thing = Thing()
    for key, value in members.items():
        setattr(thing, key, value)
    real.modules[name] = thing

module("time", ticks_ms=lambda: board.now, ticks_add=lambda a, b: a + b, ticks_diff=lambda a, b: a - b, sleep_ms=sleep_ms)
module("machine", I2C=Bus, Pin=lambda *_: None)
module("uselect", poll=Poll, POLLIN=1)
module("micropython", const=lambda value: value)
module("sys", stdin=Input())
try:
    exec(sketch, {"__name__": "__main__"})
except Over:
    pass
`);
