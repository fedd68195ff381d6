// SPDX-License-Identifier: LGPL-2.1-or-later
// The plate of plate.h as a body that a parameter file names, and an observer of the largest
// displacement, both in a library that the program taut loads.
#include "plate.h"

#include <taut/base/archive.h>
#include <taut/base/registry.h>
#include <taut/output/observer.h>
#include <taut/output/table_file.h>
#include <taut/scene/body_type.h>
#include <taut/substructure/fe_body.h>

#include <deal.II/base/parameter_handler.h>

#include <cmath>
#include <memory>

namespace
{
  class ElasticPlate : public taut::BodyType
  {
  public:
    void declare_parameters(ParameterHandler &prm) override
    {
      prm.add_parameter("Pressure", pressure, "On the whole plate, downwards [N/m^2]");
    }

    std::size_t n_dofs() const override { return plate.dofs.n_dofs(); }

    std::unique_ptr<taut::Substructure> make(const taut::BodySetting &setting) const override
    {
      Vector<double> load(plate.dofs.n_dofs()), down(plate.dofs.n_dofs());
      for (const auto dof : DoFTools::extract_dofs(
               plate.dofs, plate.element.component_mask(FEValuesExtractors::Scalar(1))))
        down[dof] = -pressure / 500.;
      plate.M.vmult(load, down); // density 500: pressure times area, spread like the mass
      taut::FEBody<2>::Options options;
      options.origin = setting.origin;
      return std::make_unique<taut::FEBody<2>>(setting.name, plate.dofs, plate.M, plate.C, plate.K,
                                               plate.constraints, load, options);
    }

  private:
    double pressure = 0.;
    Plate plate;
  };

  /// Of all DoFs of all bodies, wherever they are, from a time on.
  class LargestDisplacement : public taut::Observer
  {
  public:
    void declare_parameters(ParameterHandler &prm) override
    {
      prm.add_parameter("From", first, "Time from which on it is recorded [s]");
    }
    std::vector<std::string> files() const override { return {"largest.csv"}; }

    void begin(const taut::RunView &run) override
    {
      if (run.communicator.is_root())
        file = std::make_unique<taut::TableFile>(
            run.folder + "/largest.csv", std::vector<std::string>{"time [s]", "largest [m]"},
            run.resumes);
    }

    void save(taut::OutputArchive &archive) override
    {
      const std::size_t length = file ? file->save() : 0;
      archive << length;
    }

    void resume(taut::InputArchive &archive, const taut::StepView &) override
    {
      std::size_t length = 0;
      archive >> length;
      if (file)
        file->resume(length);
    }

    void record(const taut::StepView &step) override
    {
      if (step.state.time < first)
        return;
      double largest = 0.;
      for (const std::vector<double> &U : step.state.U)
        for (const double u : U)
          largest = std::fmax(largest, std::fabs(u));
      largest = step.structure.communicator().max(largest);
      if (!file)
        return;
      file->begin_line(step.state.time);
      *file << largest;
      file->end_line();
    }

    void finish() override
    {
      if (file)
        file->close();
    }

  private:
    double first = 0.;
    std::unique_ptr<taut::TableFile> file;
  };

  const taut::Register<taut::BodyType, ElasticPlate>
      plate_type("elastic plate", "a plate of 2 m x 1 m in plane strain, clamped at x = 0");
  const taut::Register<taut::Observer, LargestDisplacement> observer("largest displacement",
                                                                     "largest.csv: of all DoFs");
} // namespace
