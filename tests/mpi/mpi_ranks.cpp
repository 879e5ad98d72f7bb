// SPDX-License-Identifier: BSD-3-Clause
#include "spate/backend/mpi.hpp"

#include "backend/transport_laws.hpp"

namespace {

TEST(MpiRanks, Agree) { transport::expect_agreement(spate::MpiRanks{}); }
TEST(MpiRanks, Scatter) { transport::expect_scatter(spate::MpiRanks{}); }
TEST(MpiRanks, Exchange) { transport::expect_exchange(spate::MpiRanks{}); }
TEST(MpiRanks, StopTogether) { transport::expect_togetherness(spate::MpiRanks{}); }

} // namespace
