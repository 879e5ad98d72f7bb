# SPDX-License-Identifier: BSD-3-Clause
"""Formulations and families that plan and page speak of."""

SHIFTED = "sigma2+diffusion+shifting"
CORRECTED = "corrected+diffusion+shifting"
DAM = "cubic_spline 1.2, sigma2+diffusion+adami, runge_kutta2, double"  # tests/models/dam_break.cpp
