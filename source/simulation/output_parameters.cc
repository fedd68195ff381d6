// SPDX-License-Identifier: LGPL-2.1-or-later
#include "base/patterns.h"
#include <taut/simulation/parameters.h>

#include <deal.II/base/parameter_handler.h>

namespace taut
{
  using namespace dealii::Patterns;

  void OutputParameters::declare_names(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Output");
    probes.declare_names(prm);
    prm.leave_subsection();
  }

  void OutputParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    declare_names(prm);
    prm.enter_subsection("Output");
    prm.add_parameter("Folder", folder, "Where the results go; made if it does not exist",
                      Anything());
    prm.add_parameter(
        "Interval", interval,
        "Least time between two lines of sliding.csv, probes.csv, certificate.csv; 0: "
        "every step. With an interval, the first two have the least and largest value since the "
        "line before [s]",
        not_negative());
    prm.add_parameter(
        "Link interval", link_interval,
        "Least time between two lines of links.csv and supports.csv; 0: every step. With an "
        "interval, they have the least and largest value since the line before, and how often "
        "each unilateral link opened or closed [s]",
        not_negative());
    prm.add_parameter(
        "Tables", tables,
        "How these tables are written, 'csv': as text; 'binary': to sliding.bin and so "
        "on, the header line of a CSV file and then line after line of numbers as 8-byte "
        "doubles, for long runs in which text takes a fifth of the time; 'long': as csv, but "
        "links.csv has a line for each link and time, with the name of the link in a column",
        Selection("csv|binary|long"));
    prm.add_parameter(
        "Field interval", field_interval,
        "Least time between two files of the motion of all wires for ParaView; 0: none "
        "[s]",
        not_negative());
    prm.add_parameter(
        "Checkpoint interval", checkpoint_interval,
        "Time between two checkpoints, from the last of which --resume goes on with a run that was "
        "ended early, with the same results to the last bit; 0: none [s]",
        not_negative());
    const auto &known = Registry<Observer>::instance();
    prm.add_parameter("Observers", observers,
                      "What else records the steps. " + known.descriptions(),
                      List(Selection(known.names())));
    prm.add_parameter("Subdivisions", subdivisions,
                      "Pieces that each element is drawn with in these files [1]", Integer(1, 20));
    probes.declare_parameters(prm);
    prm.leave_subsection();
  }
} // namespace taut
