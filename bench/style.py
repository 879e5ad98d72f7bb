# SPDX-License-Identifier: BSD-3-Clause
"""Colours and axes of the pictures of benchmarks."""
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

BLUE, ORANGE, GREEN, PURPLE, GREY = "#2166ac", "#d6604d", "#4d9221", "#762a83", "#737373"

plt.rcParams.update(
    {
        "font.size": 11,
        "axes.titlesize": 12,
        "axes.titlelocation": "left",
        "axes.spines.top": False,
        "axes.spines.right": False,
        "axes.grid": True,
        "axes.axisbelow": True,
        "grid.color": "#e5e5e5",
        "legend.frameon": False,
        "svg.fonttype": "none",
    }
)
