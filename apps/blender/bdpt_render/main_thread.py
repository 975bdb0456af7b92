"""Calls functions in the main thread, the only one that may change Blender's data while its windows are drawn."""

import threading

import bpy


class Cancelled(Exception):
    """The user ended the render."""


def call(function, cancelled):
    """Calls function() in the main thread and returns its result. Raises Cancelled if cancelled() holds before the call
    begins."""
    if threading.current_thread() is threading.main_thread():
        return function()
    outcome, ended, turn = [], threading.Event(), threading.Lock()  # whoever acquires `turn` decides

    def run():
        if turn.acquire(blocking=False):
            try:
                outcome.append((function(), None))
            except Exception as error:  # raised again in the waiting thread
                outcome.append((None, error))
            ended.set()

    bpy.app.timers.register(run)
    while not ended.wait(0.05):
        # A user who cancels may block the main thread until this thread ends.
        if cancelled() and turn.acquire(blocking=False):
            raise Cancelled
    value, error = outcome[0]
    if error:
        raise error
    return value
