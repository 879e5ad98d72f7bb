# SPDX-License-Identifier: BSD-3-Clause
"""Snapshots that processes have written are read by h5py and by VTK's own reader, with the same values.

usage: /usr/bin/python3 readers.py SNAPSHOT...
Ends with 77 if h5py or VTK is not installed (Debian: python3-h5py-serial, python3-vtk9).
"""
import sys

try:
    import h5py
    import numpy as np
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOHDF import vtkHDFReader
except ImportError as missing:
    print(f"readers.py: {missing}")
    sys.exit(77)

for name in sys.argv[1:]:
    reader = vtkHDFReader()
    assert reader.CanReadFile(name), name
    reader.SetFileName(name)
    reader.Update()
    grid = reader.GetOutput()
    with h5py.File(name) as file:
        vtkhdf = file["VTKHDF"]
        points, data = vtkhdf["Points"][:], {k: v[:] for k, v in vtkhdf["PointData"].items()}
        time, step = vtkhdf["FieldData/TimeValue"][0], vtkhdf["FieldData/step"][0]
    n = len(points)
    assert n > 0 and grid.GetNumberOfPoints() == n and grid.GetNumberOfCells() == n, (name, n)
    assert np.array_equal(vtk_to_numpy(grid.GetPoints().GetData()), points), name
    assert {"id", "species", "velocity"} <= set(data), (name, sorted(data))
    for array, values in data.items():
        assert np.array_equal(vtk_to_numpy(grid.GetPointData().GetArray(array)), values, equal_nan=values.dtype.kind == "f"), (name, array)
    assert all(grid.GetCell(k).GetPointId(0) == k for k in (0, n // 2, n - 1)), name
    order = np.lexsort((data["id"], data["species"]))
    assert np.array_equal(order, np.arange(n)), f"{name} is not in the order of species and ids"
    print(f"{name}: {n} points at t = {time:g} s, step {step}, with {', '.join(sorted(data))}")
