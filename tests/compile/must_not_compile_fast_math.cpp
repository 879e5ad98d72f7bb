// expect: spate: do not compile with -ffast-math
// flags: -ffast-math
// SPDX-License-Identifier: BSD-3-Clause
#include <spate/spate.hpp>
