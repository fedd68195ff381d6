// SPDX-License-Identifier: LGPL-2.1-or-later
#include "study/case_runner.h"
#include <taut/base/exceptions.h>
#include <taut/simulation/simulation.h>

#include <sstream>

namespace taut
{
  namespace
  {
    std::vector<NamedQuantity> quantities_of(const Simulation &simulation)
    {
      std::vector<NamedQuantity> all = simulation.statistics().named_quantities();
      const std::vector<NamedQuantity> others = simulation.observed_quantities();
      all.insert(all.end(), others.begin(), others.end());
      return all;
    }
  } // namespace

  std::vector<NamedQuantity> CaseRunner::quantities()
  {
    set_parameters({});
    std::ostringstream silent;
    try
    {
      const Simulation simulation(*parameters, silent, Communicator(), &shared);
      return quantities_of(simulation);
    }
    catch (const EntryError &e)
    {
      throw UserError(parameters->explain(e));
    }
  }

  CaseResult CaseRunner::run(const std::vector<std::string> &entries)
  {
    set_parameters(entries);
    std::ostringstream silent;
    try
    {
      Simulation simulation(*parameters, silent, Communicator(), &shared);
      simulation.stop_if(stop_asked);
      simulation.run();
      return {quantities_of(simulation), simulation.statistics().worst_residuals()};
    }
    catch (const EntryError &e)
    {
      throw UserError(parameters->explain(e));
    }
  }

  /// Changes the parameters of the last case, or reads them anew.
  void CaseRunner::set_parameters(const std::vector<std::string> &entries)
  {
    if (parameters && parameters->change(entries))
      return;
    parameters.reset();
    std::vector<std::string> all = overrides;
    all.insert(all.end(), entries.begin(), entries.end());
    auto fresh = std::make_unique<Parameters>();
    for (const auto &[entry, place] : origins)
      fresh->set_origin(entry, place);
    fresh->read(file, all);
    fresh->write_nothing();
    parameters = std::move(fresh);
  }
} // namespace taut
