// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The concepts on one page, and how they fit together: read this first. It includes the headers in which each
/// concept is defined and declares nothing itself; docs/concepts has a page for each.
///
/// Words. Particles carry fields; neighbours meet in pairs; terms turn what neighbours carry into rates; an
/// integrator turns rates into motion; a boundary says where space ends; a backend says who does the work. A scene is
/// a type, put together in main() from plain values: wcsph(...) or dem(...) or physics(...), then Simulation(physics,
/// integrator, boundary, backend, precision, watch, neighbours).
///
/// | concept       | is                                                        | defined in                       |
/// |---------------|-----------------------------------------------------------|----------------------------------|
/// | Field         | a named quantity of each particle: rank, unit, its rate   | core/field.hpp                   |
/// | Fields<...>   | a set of fields; its algebra is done by the compiler      | core/fields.hpp                  |
/// | Term          | one addend of the equations, of a particle or of a pair   | core/term.hpp                    |
/// | Kernel        | W, its gradient factor g = f'(q)/q, its support           | kernel/kernel.hpp                |
/// | Interaction   | which pairs meet, and what a term sees of a pair          | physics/physics.hpp              |
/// | EquationOfState | p(rho), back, at rest, and its energy                   | physics/sph/equation_of_state.hpp |
/// | Integrator    | a step, with its order, cost, stability limit and growth  | integrator/integrator.hpp        |
/// | boundary      | where space ends; may own a species of markers and terms  | docs/concepts/boundary.md        |
/// | backend       | runs independent tasks                                    | docs/concepts/backend.md         |
/// | output        | begin(scene), step(scene), end(scene)                     | docs/concepts/outputs.md         |
///
/// One set decides. A term declares what it reads, writes and adds, and a View lets it touch nothing else. From the
/// union of all declarations, Model (physics/model.hpp) derives as types and constants: the species (0: the mobile
/// particles, 1: the markers of the boundary), the columns of each, which fields evolve, what is packed into the
/// record of a source, and whether the model is closed (every field that is read is given or made). What no term
/// names does not exist: no column, no place in a record, no instruction in the loop.
///
/// The plan. An integrator asks for the rates of a set of fields. Planner (physics/plan.hpp) turns that, at compile
/// time, into stages: a pass (particle terms over columns), a pack (columns into the records of a source), a sweep
/// (all pair terms that are ready, fused, over the neighbours of one target species). A term runs on a species if and
/// only if what it changes is among the fields of that species. So markers, which carry no acceleration, are never
/// accelerated. Marker with marker is never searched.
///
/// The hot loop (physics/sweep.hpp). W targets lie in the lanes of a pack; the k-th neighbour of each is loaded as a
/// record and transposed in registers; every fused term adds to sums in registers; one store at the end. A pair term
/// changes i only, so targets are independent: no atomics, no colouring. Each lane sums its own particle's neighbours
/// in the order (bin, id), so the bits do not depend on W, on threads, on cells, on the skin.
///
/// Who is near whom (cells/). Bins are one global integer grid; particles are sorted by (cell, bin, id); a cell is
/// the unit of work; neighbour lists with a skin are kept until some pair may have closed in by the skin. Periodic
/// images are records with a shifted position.
///
/// A step (simulation.hpp). Extremes of the state; the watch; dt by the criteria; lists rebuilt if they may miss a
/// pair; terms of `before_step`; the integrator; terms of `after_step`; outputs. No output changes a bit of the run.
///
/// Includes point one way, and a test checks it: core <- kernel, cells <- physics; core <- integrator, boundary,
/// backend, measure, io (boundary may also include cells; none of these knows physics or each other); all <-
/// simulation <- spate.hpp.
///
/// What must stay true of every change: the same bits on any backend and any number of threads; no term sees what it
/// did not declare; a scene without a feature holds no trace of it; a wrong program gets one sentence that begins
/// with `spate:` and names the cure; a wrong number gets one before step 0; a run that goes wrong stops and says
/// where.
#pragma once

#include "spate/backend/backend.hpp"
#include "spate/boundary/boundary.hpp"
#include "spate/core/field.hpp"
#include "spate/core/fields.hpp"
#include "spate/core/term.hpp"
#include "spate/integrator/integrator.hpp"
#include "spate/kernel/kernel.hpp"
#include "spate/physics/physics.hpp"
#include "spate/physics/sph/equation_of_state.hpp"
