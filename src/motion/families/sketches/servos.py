# @NAME@: hobby servos on a PCA9685 (I2C address 0x40), for MicroPython (a Raspberry Pi Pico: SDA on GP0, SCL on GP1). Made by plushwright.
# The PCA9685 has its own supply for the servos, 5 to 6 V; its ground joins that of the microcontroller.
@HEAD@
# Save it as main.py. Lines over the serial port, newline at the end:
#   setup   once: all servos go to their first pulse, WITHOUT cables. Then tie the cables on, just slack.
#   motion  plays the animation from rest, as often as you like. It never sets zero.
#   stop    breaks off, goes slowly back to rest, then switches the servos off.
#   on, off, go MS US US ..., ?   for a computer that plays live.
import sys
import time
import uselect
from machine import I2C, Pin
from micropython import const

BOARD = const(0x40)
SERVOS = const(@SERVOS@)
# Pulses at rest and the farthest ones, microseconds.
REST = (@REST@,)
FARTHEST = (@FARTHEST@,)
# Time of the way back to rest, ms.
HOME_MS = const(@HOME_MS@)
# Rows of the motion: milliseconds since the row before, then the pulse of each servo, microseconds.
TABLE = (
@TABLE@)

IDLE, GOING, PLAYING, LEAVING = range(4)


class Servos:
    def __init__(self, bus):
        self.bus = bus
        self.at = list(REST)
        self.begin = list(REST)
        self.to = list(REST)
        self.began = self.lasts = self.row = 0
        self.state = IDLE
        self.switched_on = False
        # Asleep, 50 Hz (25 MHz / 4096 / 50 - 1), awake.
        for register, value in ((0x00, 0x10), (0xFE, 121), (0x00, 0x20)):
            bus.writeto_mem(BOARD, register, bytes((value,)))
        self.switch_off()

    def pulse(self, servo, us):
        off = (us * 4096 + 10000) // 20000 if us else 4096
        self.bus.writeto_mem(BOARD, 0x06 + 4 * servo, bytes((0, 0, off & 0xFF, off >> 8)))

    def switch_off(self):
        for servo in range(SERVOS):
            self.pulse(servo, 0)
        self.switched_on = False
        self.state = IDLE

    def go(self, pulses, ms, state):
        self.begin = list(self.at)
        self.to = list(pulses)
        self.began = time.ticks_ms()
        self.lasts = ms
        self.state = state
        self.switched_on = True

    def next_row(self):
        if self.row + 1 >= len(TABLE):
            return False
        self.row += 1
        due = time.ticks_add(self.began, self.lasts)
        self.go(TABLE[self.row][1:], TABLE[self.row][0], PLAYING)
        # Rows follow each other without a gap, however late this one is seen.
        self.began = due
        return True

    def follow(self):
        if self.state == IDLE:
            return
        passed = time.ticks_diff(time.ticks_ms(), self.began)
        there = passed >= self.lasts
        for i in range(SERVOS):
            way = self.to[i] - self.begin[i]
            self.at[i] = self.to[i] if there else self.begin[i] + way * passed // self.lasts
            if self.switched_on:
                self.pulse(i, self.at[i])
        if not there or self.state == PLAYING and self.next_row():
            return
        if self.state == LEAVING:
            self.switch_off()
        self.state = IDLE

    def obey(self, words):
        word = words[0]
        if word == "setup":
            self.at = list(REST)
            self.go(REST, 0, GOING)
        elif word == "motion":
            self.row = 0
            # To rest first, where it is not.
            self.go(REST, 0 if self.at == list(REST) else HOME_MS, PLAYING)
        elif word == "stop":
            self.go(REST, HOME_MS, LEAVING)
        elif word == "on":
            self.go(self.at, 0, GOING)
        elif word == "off":
            self.switch_off()
        elif word == "go":
            return self.go_line(words[1:])
        elif word == "?":
            return " ".join(str(us) for us in self.at)
        else:
            return "error unknown"
        return "ok"

    def go_line(self, words):
        try:
            ms, *pulses = [int(word) for word in words]
        except ValueError:
            return "error pulses"
        if len(pulses) != SERVOS or ms < 0:
            return "error pulses"
        for us, rest, farthest in zip(pulses, REST, FARTHEST):
            if not min(rest, farthest) - 1 <= us <= max(rest, farthest) + 1:
                return "error limit"
        if not self.switched_on:
            return "error off"
        self.go(pulses, ms, GOING)
        return "ok"


def run(servos):
    ready = uselect.poll()
    ready.register(sys.stdin, uselect.POLLIN)
    line = ""
    print("plushwright servos")
    while True:
        while ready.poll(0):
            letter = sys.stdin.read(1)
            if not letter:
                return
            if letter in "\r\n":
                if line.split():
                    print(servos.obey(line.split()))
                line = ""
            else:
                line += letter
        servos.follow()
        time.sleep_ms(5)


run(Servos(I2C(0, sda=Pin(0), scl=Pin(1), freq=400000)))
