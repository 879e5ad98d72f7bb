// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief spate: particle methods put together at compile time. Everything but io/, which
/// needs libraries, and backend/mpi.
#pragma once

#include "spate/backend/serial.hpp"
#include "spate/backend/threads.hpp"
#include "spate/boundary/adami.hpp"
#include "spate/boundary/bce.hpp"
#include "spate/boundary/by_continuity.hpp"
#include "spate/boundary/open.hpp"
#include "spate/boundary/periodic.hpp"
#include "spate/concepts.hpp"
#include "spate/integrator/forward_euler.hpp"
#include "spate/integrator/leapfrog.hpp"
#include "spate/integrator/runge_kutta2.hpp"
#include "spate/integrator/symplectic_euler.hpp"
#include "spate/kernel/cubic_spline.hpp"
#include "spate/kernel/quintic_spline.hpp"
#include "spate/kernel/wendland_c2.hpp"
#include "spate/kernel/wendland_c4.hpp"
#include "spate/kernel/wendland_c6.hpp"
#include "spate/measure/front.hpp"
#include "spate/measure/gauge.hpp"
#include "spate/measure/leaks.hpp"
#include "spate/measure/probe.hpp"
#include "spate/measure/wall_force.hpp"
#include "spate/physics/dem.hpp"
#include "spate/physics/wcsph.hpp"
#include "spate/simulation.hpp"
