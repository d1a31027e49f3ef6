"""Reads mesh files with meshio and prints what it found as JSON, one object a line.

Real numbers are printed as the integers that have their bits, so that nothing is rounded on the way.
"""

import json
import sys

import meshio
import numpy as np


def numbers(array):
    """All numbers of an array, in order, and whether they are real."""
    array = np.ascontiguousarray(array)
    if array.dtype.kind == "f":
        return {"real": True, "values": array.astype(np.float64).view(np.uint64).ravel().tolist()}
    return {"real": False, "values": array.astype(np.int64).ravel().tolist()}


def components(array):
    return 1 if array.ndim == 1 else array.shape[1]


def described(mesh):
    point_data = {
        name: {"components": components(data), **numbers(data)}
        for name, data in mesh.point_data.items()
    }
    cell_data = {
        name: {"components": components(blocks[0]), **numbers(np.concatenate(blocks))}
        for name, blocks in mesh.cell_data.items()
    }
    return {
        "points": numbers(mesh.points),
        "cells": [[block.type, np.asarray(block.data).tolist()] for block in mesh.cells],
        "point_data": point_data,
        "cell_data": cell_data,
        "field_data": {name: np.asarray(data).tolist() for name, data in mesh.field_data.items()},
    }


for path in sys.argv[1:]:
    print(json.dumps(described(meshio.read(path))))
