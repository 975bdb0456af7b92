"""Calls in the main thread, the only one that may change Blender's data while its windows are drawn."""

import threading

import bpy


class Cancelled(Exception):
    """The user ended the render."""


def call(function, cancelled):
    """function(), in the main thread. Gives up, before it has begun, when cancelled() says so."""
    if threading.current_thread() is threading.main_thread():
        return function()
    outcome, ended, turn = [], threading.Event(), threading.Lock()  # who takes the turn decides whether it runs

    def run():
        if turn.acquire(blocking=False):
            try:
                outcome.append((function(), None))
            except Exception as error:  # raised again in the thread that waits
                outcome.append((None, error))
            ended.set()

    bpy.app.timers.register(run)
    while not ended.wait(0.05):
        # Who cancels may wait for this thread in the main one.
        if cancelled() and turn.acquire(blocking=False):
            raise Cancelled
    value, error = outcome[0]
    if error:
        raise error
    return value
