"""Opens mesh files with VTK, PyVista and Gmsh and prints what they found as JSON, one object a line.

Real numbers are printed as the integers that have their bits, so that nothing is rounded on the way.
"""

import json
import sys

import gmsh
import numpy as np
import pyvista
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersVerdict import vtkCellSizeFilter
from vtkmodules.vtkIOXML import (
    vtkXMLImageDataReader,
    vtkXMLPolyDataReader,
    vtkXMLUnstructuredGridReader,
)


def bits(array):
    return np.ascontiguousarray(array, dtype=np.float64).view(np.uint64).ravel().tolist()


def arrays(data):
    found = {}
    for index in range(data.GetNumberOfArrays()):
        array = data.GetArray(index)
        found[array.GetName()] = {
            "components": array.GetNumberOfComponents(),
            "type": array.GetDataTypeAsString(),
            "values": bits(vtk_to_numpy(array)),
        }
    return found


def read_vtk(reader, path):
    """Reads a file; a complaint of the reader is an error."""
    complaints = []
    reader.AddObserver("ErrorEvent", lambda *_: complaints.append("error"))
    reader.AddObserver("WarningEvent", lambda *_: complaints.append("warning"))
    reader.SetFileName(path)
    reader.Update()
    if complaints:
        raise RuntimeError(f"{path}: VTK complains: {complaints}")
    return reader.GetOutput()


def vtu(path):
    grid = read_vtk(vtkXMLUnstructuredGridReader(), path)
    sizes = vtkCellSizeFilter()
    sizes.SetInputData(grid)
    sizes.Update()
    cell_data = sizes.GetOutput().GetCellData()
    volumes, areas = (vtk_to_numpy(cell_data.GetArray(name)) for name in ("Volume", "Area"))
    points = vtk_to_numpy(grid.GetPoints().GetData()) if grid.GetNumberOfPoints() else np.zeros(0)
    mesh = pyvista.read(path)
    return {
        "points": bits(points),
        "types": [grid.GetCellType(cell) for cell in range(grid.GetNumberOfCells())],
        "connectivity": vtk_to_numpy(grid.GetCells().GetConnectivityArray()).tolist(),
        "sizes": (volumes + areas).tolist(),
        "point_data": arrays(grid.GetPointData()),
        "cell_data": arrays(grid.GetCellData()),
        "pyvista": [mesh.n_points, mesh.n_cells, sorted(mesh.array_names)],
        "pyvista_groups": {name: list(map(int, mesh.field_data[name])) for name in mesh.field_data},
    }


def vtp(path):
    surface = read_vtk(vtkXMLPolyDataReader(), path)
    mesh = pyvista.read(path)
    return {
        "points": bits(vtk_to_numpy(surface.GetPoints().GetData())),
        "triangles": vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).tolist(),
        "offsets": vtk_to_numpy(surface.GetPolys().GetOffsetsArray()).tolist(),
        "point_data": arrays(surface.GetPointData()),
        "cell_data": arrays(surface.GetCellData()),
        "area": mesh.area,
        "pyvista": [mesh.n_points, mesh.n_cells, sorted(mesh.array_names)],
    }


def pvd(path):
    reader = pyvista.get_reader(path)
    frames = []
    for time in reader.time_values:
        reader.set_active_time_value(time)
        frames.append([bits([time])[0], reader.read()[0].n_cells])
    return {"frames": frames}


def vti(path):
    image = read_vtk(vtkXMLImageDataReader(), path)
    mesh = pyvista.read(path)
    return {
        "extent": list(image.GetExtent()),
        "origin": bits(image.GetOrigin()),
        "spacing": bits(image.GetSpacing()),
        "point_data": arrays(image.GetPointData()),
        "cell_data": arrays(image.GetCellData()),
        "pyvista": [mesh.n_points, mesh.n_cells, sorted(mesh.array_names)],
    }


def msh(path):
    gmsh.clear()
    gmsh.logger.start()
    gmsh.open(path)
    complaints = [line for line in gmsh.logger.get() if line.startswith(("Warning", "Error"))]
    gmsh.logger.stop()
    if complaints:
        raise RuntimeError(f"{path}: Gmsh complains: {complaints}")
    node_tags, coordinates, _ = gmsh.model.mesh.getNodes()
    order = np.argsort(node_tags)
    cells = {}
    sizes = {}
    for kind in (2, 3, 4, 5):
        tags, nodes = gmsh.model.mesh.getElementsByType(kind)
        by_tag = np.argsort(tags)
        corners = np.asarray(nodes).reshape(len(tags), -1) if len(tags) else np.zeros((0, 0), int)
        cells[str(kind)] = (corners[by_tag].astype(int) - 1).ravel().tolist()
        if len(tags) and kind in (4, 5):
            sizes[str(kind)] = gmsh.model.mesh.getElementQualities(sorted(tags), "volume").tolist()
            sizes[str(kind)] += gmsh.model.mesh.getElementQualities(sorted(tags), "minDetJac").tolist()
    groups = {}
    names = {}
    for dimension, tag in gmsh.model.getPhysicalGroups():
        members = 0
        for entity in gmsh.model.getEntitiesForPhysicalGroup(dimension, tag):
            members += sum(map(len, gmsh.model.mesh.getElements(dimension, entity)[1]))
        groups[f"{dimension} {tag}"] = members
        name = gmsh.model.getPhysicalName(dimension, tag)
        if name:
            names[f"{dimension} {tag}"] = name
    views = {}
    for view in gmsh.view.getTags():
        kind, _, values, _, components = gmsh.view.getHomogeneousModelData(view, 0)
        name = gmsh.option.getString(f"View[{gmsh.view.getIndex(view)}].Name")
        views[name] = {"kind": kind, "components": components, "values": bits(values)}
    return {
        "points": bits(np.asarray(coordinates).reshape(-1, 3)[order]),
        "cells": cells,
        "sizes": sizes,
        "groups": groups,
        "names": names,
        "views": views,
    }


gmsh.initialize()
gmsh.option.setNumber("General.Terminal", 0)
for path in sys.argv[1:]:
    describe = {"vtu": vtu, "vti": vti, "vtp": vtp, "pvd": pvd, "msh": msh}[path.rsplit(".", 1)[1]]
    print(json.dumps(describe(path)))
gmsh.finalize()
