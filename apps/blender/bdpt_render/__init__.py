"""Makes bdpt a render engine of Blender: exports a frame as GLB, runs the command, and shows its image."""

from . import engine, settings

bl_info = {"name": "bdpt", "description": "Render by bidirectional path tracing", "author": "The developers of bdpt",
           "version": (0, 2, 0), "blender": (3, 4, 0), "category": "Render",
           "location": "Render Properties > Render Engine > bdpt"}

MODULES = (settings, engine)


def register():
    for module in MODULES:
        module.register()


def unregister():
    for module in reversed(MODULES):
        module.unregister()
