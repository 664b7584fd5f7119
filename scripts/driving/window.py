"""The real window under a virtual display, driven with real mouse and keys; controls are found by the names that a screen reader says.

`plushwright --controls` tells on standard output, whenever they change, all controls with their places; nothing here knows where one is.
Needs Xvfb, xdotool and ImageMagick (`import`).
"""

import json
import os
import re
import signal
import subprocess
import threading
import time

PATIENCE_S = 60.0
# The window rests when its controls have not changed for so long.
REST_S = 0.35


class Lost(Exception):
    """Something that should be in the window is not."""


class Display:
    """A virtual screen."""

    def __init__(self, number, size):
        self.name = f":{number}"
        command = ["Xvfb", self.name, "-screen", "0", f"{size[0]}x{size[1]}x24", "-nolisten", "tcp", "-noreset"]
        self.process = subprocess.Popen(command, stderr=subprocess.DEVNULL)
        time.sleep(1.5)

    def end(self):
        self.process.terminate()
        self.process.wait()


class Control:
    """A control as it was told."""

    def __init__(self, told):
        self.role, self.name = told["role"], told["name"]
        self.value, self.on, self.enabled = told.get("value"), told.get("on"), told["enabled"]
        self.rect, self.seen = told["rect"], told.get("seen")

    def middle(self):
        left, top, right, bottom = self.seen or self.rect
        return (left + right) / 2, (top + bottom) / 2


class Window:
    """A window of `program`, with a folder of its own for what it keeps."""

    def __init__(self, program, display, state, scale=1, arguments=()):
        self.environment = {
            **{k: v for k, v in os.environ.items() if k not in ("WAYLAND_DISPLAY", "DBUS_SESSION_BUS_ADDRESS", "XDG_RUNTIME_DIR")},
            "DISPLAY": display.name,
            "XDG_STATE_HOME": str(state),
            # Controls are found by their English names.
            "LANGUAGE": "en",
            "WINIT_X11_SCALE_FACTOR": str(scale),
        }
        self.told, self.changed = [], 0.0
        # More pixels take longer where everything is drawn in software.
        self.rest_s = REST_S * scale * scale
        self.process = subprocess.Popen(
            [str(program), "--controls", *map(str, arguments)],
            stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, env=self.environment, text=True,
        )
        threading.Thread(target=self._listen, daemon=True).start()
        self.wait("controls", lambda: self.told)
        self.id = self._xdotool("search", "--sync", "--onlyvisible", "--name", "^Plushwright", patience=30).split()[-1]
        self._xdotool("windowfocus", self.id)
        self.rests()

    def _listen(self):
        for line in self.process.stdout:
            self.told, self.changed = [Control(told) for told in json.loads(line)], time.monotonic()

    def _xdotool(self, *words, patience=20):
        command = ["xdotool", *map(str, words)]
        return subprocess.run(command, env=self.environment, timeout=patience, check=True, capture_output=True, text=True).stdout

    # What is seen.

    def wait(self, what, is_so, patience=PATIENCE_S):
        """Waits until something is so, and returns it."""
        until = time.monotonic() + patience
        while True:
            found = is_so()
            if found:
                return found
            if time.monotonic() > until or self.process.poll() is not None:
                raise Lost(f"{what}: not there after {patience:.0f} s; the window has {sorted({c.name for c in self.told})}")
            time.sleep(0.05)

    def rests(self, patience=20.0):
        """Waits until nothing changes any more."""
        until = time.monotonic() + patience
        time.sleep(0.4 * self.rest_s)
        while time.monotonic() - self.changed < self.rest_s and time.monotonic() < until:
            time.sleep(0.05)

    def all(self, name, role=None):
        """The controls of a name; a pattern where it is one."""
        is_one = name.fullmatch if isinstance(name, re.Pattern) else lambda said: said == name
        return [c for c in self.told if is_one(c.name) and (role is None or c.role == role)]

    def has(self, name, role=None):
        return bool(self.all(name, role))

    def find(self, name, role=None, number=0, patience=PATIENCE_S):
        """A control that can be pressed; it is scrolled to where that is needed."""
        def there():
            found = self.all(name, role)
            return found[number] if len(found) > number else None
        control = self.wait(f"“{name}”", there, patience)
        for _ in range(40):
            if control.seen and self._is_whole(control):
                return control
            self._scroll_to(control)
            control = self.wait(f"“{name}”", there, patience)
        raise Lost(f"“{name}” is covered, or cannot be scrolled to: {control.rect}")

    @staticmethod
    def _is_whole(control):
        """Whether its middle can be pressed."""
        x, y = (control.rect[0] + control.rect[2]) / 2, (control.rect[1] + control.rect[3]) / 2
        left, top, right, bottom = control.seen
        return left - 1 <= x <= right + 1 and top - 1 <= y <= bottom + 1

    def _scroll_to(self, control):
        """Turns the wheel over what stands in the same column."""
        x, y = (control.rect[0] + control.rect[2]) / 2, (control.rect[1] + control.rect[3]) / 2
        column = [c for c in self.told if c.seen and c.role != "Canvas" and c.seen[0] <= x <= c.seen[2]]
        if not column:
            time.sleep(0.3)
            return
        nearest = min(column, key=lambda c: abs(c.middle()[1] - y))
        wheel = 5 if y > nearest.middle()[1] else 4
        self.move(*nearest.middle())
        self._xdotool("click", wheel)
        self.rests(3.0)

    def title(self):
        return self._xdotool("getwindowname", self.id).strip()

    def picture(self, path):
        """What the window shows."""
        subprocess.run(["import", "-window", self.id, str(path)], env=self.environment, timeout=30, check=True)

    # Hands.

    def move(self, x, y):
        self._xdotool("mousemove", round(x), round(y), "sleep", 0.08)

    def press(self, x, y, button=1):
        """A click, slow enough to be seen by a window that draws in software."""
        self._xdotool("mousemove", round(x), round(y), "sleep", 0.15, "mousedown", button, "sleep", 0.1, "mouseup", button)
        self.rests()

    def click(self, name, role=None, number=0, patience=PATIENCE_S, button=1):
        self.press(*self.find(name, role, number, patience).middle(), button)

    def hover(self, name, role=None, number=0):
        self.move(*self.find(name, role, number).middle())
        self.rests(3.0)

    def drag(self, way, release=True, steps=8):
        """From the first point of a way to its last one."""
        words = ["mousemove", round(way[0][0]), round(way[0][1]), "sleep", 0.2, "mousedown", 1, "sleep", 0.1]
        for (ax, ay), (bx, by) in zip(way, way[1:]):
            for k in range(1, steps + 1):
                words += ["mousemove", round(ax + (bx - ax) * k / steps), round(ay + (by - ay) * k / steps), "sleep", 0.04]
        words += ["sleep", 0.15]
        self._xdotool(*words, *(["mouseup", 1] if release else []))
        if release:
            self.rests()

    def release(self):
        self._xdotool("mouseup", 1)
        self.rests()

    def key(self, keys):
        self._xdotool("key", keys)
        self.rests()

    def type(self, text):
        self._xdotool("type", "--delay", 15, text, patience=60)
        self.rests()

    def fill(self, name, text):
        """Types over what a field holds; keys that come in the frame of the click that gives it the focus are lost, so each is given ever longer."""
        for attempt in range(5):
            pause = 0.5 * attempt * self.rest_s / REST_S
            self.click(name)
            time.sleep(pause)
            self.key("ctrl+a")
            time.sleep(pause)
            self.type(text)
            until = time.monotonic() + 2.0 + pause
            while time.monotonic() < until:
                if self.find(name).value == text:
                    return
                time.sleep(0.1)
        raise Lost(f"“{name}” does not take “{text}”: {self.find(name).value}")

    def command(self, words):
        """Runs a command from the palette."""
        self.look_for(words)
        self.key("Return")

    def look_for(self, words):
        """Opens the palette, and types what is looked for."""
        self.key("ctrl+shift+p")
        self.fill("Look for a command", words)

    def gone(self, name):
        """Waits until a control is no longer there."""
        self.wait(f"“{name}” gone", lambda: not self.has(name))
        self.rests()

    def kill(self):
        self.process.send_signal(signal.SIGKILL)
        self.process.wait()

    def ended(self, patience=15.0):
        """Whether it closes by itself; its exit code."""
        return self.process.wait(timeout=patience)
