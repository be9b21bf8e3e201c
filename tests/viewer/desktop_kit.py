"""What a desktop does with windows, over the X protocol: manages them, drops files on them."""

import select
import time
import urllib.parse

from Xlib import X, Xatom, display as xlib
from Xlib.protocol import event as xevent

from kit import *

# Windows without a frame, in the upper left corner: what is seen of them is read from there.
SETTINGS = """<?xml version="1.0"?>
<JWM>
  <Group>
    <Class>argand</Class>
    <Option>noborder</Option><Option>notitle</Option>
    <Option>x:0</Option><Option>y:0</Option>
  </Group>
  <Desktops width="1" height="1"/>
</JWM>
"""


class Desktop:
    """A client of its own beside the viewer's."""

    def __init__(self):
        self.server = xlib.Display()
        self.root = self.server.screen().root
        self.root.change_attributes(event_mask=X.SubstructureNotifyMask)
        self.manager = None

    def close(self):
        if self.manager:
            self.manager.terminate()
            self.manager.wait()
            self.root.delete_property(self.atom("_NET_SUPPORTING_WM_CHECK"))
            self.server.sync()
        self.server.close()

    def manage(self):
        """Start a window manager."""
        self.server.xfixes_query_version()
        self.root.xfixes_hide_cursor()  # it is no part of the picture
        path = os.path.join(here, "jwmrc")
        with open(path, "w") as file:
            file.write(SETTINGS)
        self.manager = subprocess.Popen(["jwm", "-f", path])
        until(lambda: self.property(self.root, "_NET_SUPPORTING_WM_CHECK"), "a window manager")

    def set_density(self, dpi):
        """Of all windows that are opened from now on."""
        value = f"Xft.dpi:\t{dpi}\n".encode()
        self.root.change_property(Xatom.RESOURCE_MANAGER, Xatom.STRING, 8, value)
        self.server.sync()

    def atom(self, name):
        return self.server.intern_atom(name)

    def property(self, window, name):
        found = window.get_full_property(self.atom(name), X.AnyPropertyType)
        return list(found.value) if found else []

    def window_of(self, viewer):
        return self.server.create_resource_object("window", int(viewer.window()))

    def size_of(self, window):
        shape = window.get_geometry()
        return shape.width, shape.height

    def send(self, window, kind, numbers, to=None):
        data = (32, (list(numbers) + [0] * 5)[:5])
        message = xevent.ClientMessage(window=window, client_type=self.atom(kind), data=data)
        managers = X.SubstructureNotifyMask | X.SubstructureRedirectMask
        (to or window).send_event(message, event_mask=managers if to else 0)
        self.server.flush()

    def await_event(self, fits, what):
        end = time.monotonic() + PATIENCE_S
        while True:
            while self.server.pending_events():
                event = self.server.next_event()
                if fits(event):
                    return event
            left = end - time.monotonic()
            check(left > 0, f"in vain: {what}")
            select.select([self.server.fileno()], [], [], left)

    # ---- What it asks of windows

    def answer_s(self, window):
        """How long the window takes to say that it lives."""
        ping, start = self.atom("_NET_WM_PING"), time.monotonic()
        stamp = int(start * 1e6) & 0x7FFFFFFF
        self.send(window, "WM_PROTOCOLS", (ping, stamp, window.id))

        def answers(event):
            return event.type == X.ClientMessage and list(event.data[1][:2]) == [ping, stamp]

        self.await_event(answers, "an answer of the window")
        return time.monotonic() - start

    def minimise(self, window):
        self.send(window, "WM_CHANGE_STATE", (3,), to=self.root)
        until(lambda: window.get_wm_state().state == 3, "the window is minimised")

    def restore(self, window):
        self.send(window, "_NET_ACTIVE_WINDOW", (1,), to=self.root)
        until(lambda: window.get_wm_state().state == 1, "the window is restored")

    def maximise(self, window, does):
        both = [self.atom(f"_NET_WM_STATE_MAXIMIZED_{way}") for way in ("HORZ", "VERT")]
        self.send(window, "_NET_WM_STATE", (int(does), *both, 1), to=self.root)

    # ---- Dropping files: the source of XDND, version 5

    def drop(self, window, *paths):
        files = "".join(f"file://{urllib.parse.quote(path)}\r\n" for path in paths).encode()
        source = self.root.create_window(0, 0, 1, 1, 0, X.CopyFromParent)
        check(self.property(window, "XdndAware"), "files cannot be dropped")
        source.set_selection_owner(self.atom("XdndSelection"), X.CurrentTime)
        self.send(window, "XdndEnter", (source.id, 5 << 24, self.atom("text/uri-list")))
        copy, place = self.atom("XdndActionCopy"), 100 << 16 | 80
        self.send(window, "XdndPosition", (source.id, 0, place, X.CurrentTime, copy))
        answer = self.await_event(self.told("XdndStatus"), "an answer to what is dragged")
        check(answer.data[1][1] & 1, "the window does not take it")
        self.send(window, "XdndDrop", (source.id, 0, X.CurrentTime))
        asked = self.await_event(lambda e: e.type == X.SelectionRequest, "the files are asked for")
        asked.requestor.change_property(asked.property, asked.target, 8, files)
        asked.requestor.send_event(xevent.SelectionNotify(
            time=asked.time, requestor=asked.requestor, selection=asked.selection,
            target=asked.target, property=asked.property,
        ))
        self.server.flush()
        self.await_event(self.told("XdndFinished"), "the end of the drop")
        source.destroy()

    def told(self, kind):
        return lambda e: e.type == X.ClientMessage and e.client_type == self.atom(kind)
