// SPDX-License-Identifier: LGPL-2.1-or-later
// Claim: what ranks exchange, and the errors that they share, are the same on all of them. Source:
// sums of whole numbers in closed form; ranks, places and kinds of errors drawn by all ranks alike.
#include "common.h"

#include "base/rank_abort.h"
#include "fuzz/library_bodies.h"
#include <taut/base/communicator.h>
#include <taut/base/exceptions.h>
#include <taut/substructure/structure.h>

#include <new>

namespace
{
  /// Of all ranks; r is the own one of n.
  class Communicator : public testing::Test
  {
  protected:
    const taut::Communicator processes = taut::Communicator(MPI_COMM_WORLD);
    const unsigned int n = processes.size(), r = processes.rank();
  };
} // namespace

// Claim: sums, maxima and gathered numbers are those of all ranks, on each of them. Expected: of
// the ranks' numbers r + 1 the sum n (n + 1) / 2; whole numbers, so exactly.
TEST_F(Communicator, sums_and_maxima_are_those_of_all_ranks)
{
  std::vector<double> values = {r + 1., -2. * r, 1.};
  processes.sum(values);
  EXPECT_EQ(values, (std::vector<double>{n * (n + 1.) / 2., -1. * n * (n - 1.), 1. * n}));
  EXPECT_EQ(processes.max(r + 1.), n);
  EXPECT_EQ(processes.max(-1. - r), -1.);
  values = {-1. * r, 1. + r};
  processes.max(values);
  EXPECT_EQ(values, (std::vector<double>{0., 1. * n}));
  std::vector<std::size_t> squares;
  processes.gather(r * r, squares);
  ASSERT_EQ(squares.size(), n);
  for (unsigned int i = 0; i < n; ++i)
    EXPECT_EQ(squares[i], i * i);
}

// Claim: not-a-number of one rank is the maximum, whichever rank has it and however large the
// others.
TEST_F(Communicator, not_a_number_of_one_rank_is_the_maximum)
{
  for (unsigned int owner = 0; owner < n; ++owner)
    EXPECT_TRUE(
        std::isnan(processes.max(r == owner ? std::numeric_limits<double>::quiet_NaN() : 1e300)));
}

// Claim: text of the root reaches all ranks, of any length.
TEST_F(Communicator, text_of_the_root_reaches_all_ranks)
{
  for (const std::size_t length : {0, 1, 100000})
  {
    std::string text(r == 0 ? length : 7 * r, r == 0 ? 'a' : 'b');
    processes.broadcast(text);
    EXPECT_EQ(text, std::string(length, 'a'));
  }
}

// Claim: an error of one rank is that of all, with its entry; of several, that of the lowest rank.
TEST_F(Communicator, an_error_of_one_rank_is_that_of_all)
{
  for (unsigned int first = 0; first < n; ++first)
    for (const bool alone : {true, false})
      try
      {
        processes.agree(
            [&]
            {
              if (r == first || (!alone && r > first))
                throw taut::EntryError("Rank/" + std::to_string(r), "wrong");
            });
        ADD_FAILURE() << "the error of rank " << first << " was lost";
      }
      catch (const taut::EntryError &e)
      {
        EXPECT_EQ(e.entry(), "Rank/" + std::to_string(first));
        EXPECT_EQ(e.message(), "wrong");
      }
  processes.agree([] {});
}

// Claim: so it is of many agreements one after the other, whichever of them one rank fails in: all
// ranks leave at the same one with the kind and the message of that rank. Expected: the rank, the
// number of the agreement and the kind, drawn at random by all ranks alike.
TEST_F(Communicator, all_ranks_leave_at_the_agreement_in_which_one_throws)
{
  std::mt19937 random(1);
  for (int round = 0; round < 400; ++round)
  {
    const unsigned int thrower = random() % n, at = random() % 50, kind = random() % 3;
    const std::string message = "round " + std::to_string(round);
    unsigned int i = 0;
    unsigned int found = 3;
    std::string said = message;
    try
    {
      for (; i < 50; ++i)
        processes.agree(
            [&]
            {
              if (r != thrower || i != at)
                return;
              if (kind == 0)
                throw taut::UserError(message);
              if (kind == 1)
                throw std::runtime_error(message);
              throw std::bad_alloc();
            });
    }
    catch (const std::exception &e)
    {
      found = dynamic_cast<const taut::UserError *>(&e)  ? 0
              : dynamic_cast<const std::bad_alloc *>(&e) ? 2
                                                         : 1;
      said = found == 2 ? message : e.what();
    }
    ASSERT_EQ(i, at);
    ASSERT_EQ(found, kind);
    ASSERT_EQ(said, message);
  }
}

// Claim: an error that all ranks come with is said by the root alone, and no rank ends another.
TEST_F(Communicator, the_root_says_what_all_ranks_know)
{
  taut::RankAbort rank_abort(processes);
  EXPECT_EQ(rank_abort.are_own(), r == 0);
  rank_abort.end_others(1);
}

// Claim: where one of several bodies cannot be made, none is added on any rank. Expected: the error
// of its rank, and numbers and names of a body that is added then.
TEST_F(Communicator, a_structure_is_as_before_where_a_body_fails)
{
  taut::Structure structure(processes);
  const auto make = [] { return library::chain_of("mass", {1.}, {1.}); };
  const auto fail = []() -> std::shared_ptr<taut::Substructure>
  { throw taut::UserError("no body"); };
  EXPECT_THROW(structure.add({{"first", 0, make}, {"second", n - 1, fail}}), taut::UserError);
  EXPECT_EQ(structure.size(), 0u);
  EXPECT_TRUE(structure.all_bodies().empty());
  EXPECT_EQ(structure.add("third", n - 1, make), r == n - 1 ? 0u : taut::Structure::elsewhere);
  ASSERT_EQ(structure.all_bodies().size(), 1u);
  EXPECT_EQ(structure.all_bodies()[0].name, "third");
  EXPECT_EQ(structure.all_bodies()[0].n_dofs, 1u);
}
