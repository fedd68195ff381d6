// SPDX-License-Identifier: LGPL-2.1-or-later
// Figures of contact forces and of droppers against records whose figures are known.
#include "common.h"

#include "output/signals.h"
#include <taut/output/contact_quantities.h>
#include <taut/output/sliding_contacts.h>
#include <taut/output/support_figures.h>

using verification::pi;

using namespace taut;

namespace
{

  /// 100 N, and waves of 8 N at 1 Hz and 4 N at 10 Hz, for 20 s at 1 ms and 10 m/s.
  ContactRecord waves(std::vector<double> &times)
  {
    ContactRecord record;
    for (int i = 0; i <= 20000; ++i)
    {
      const double t = 1e-3 * i;
      times.push_back(t);
      record.position.push_back(10. * t);
      record.force.push_back(100. + 8. * std::sin(2. * pi * t) + 4. * std::sin(20. * pi * t));
      record.height.push_back(.03 * std::cos(pi * t / 10.));
    }
    record.mean_force = record.force;
    return record;
  }

  /// Amplitude of low_pass() by its definition.
  double damping(const double f, const double cutoff)
  {
    return 1. / (1. + (std::sqrt(2.) - 1.) * std::pow(f / cutoff, 6));
  }

  double variance_of(const std::vector<double> &record)
  {
    double mean = 0., variance = 0.;
    for (const double value : record)
      mean += value / record.size();
    for (const double value : record)
      variance += (value - mean) * (value - mean) / record.size();
    return variance;
  }
} // namespace

// Expected: the standard deviation of a wave is its amplitude over the root of two, in the bands
// with its frequency alone. The window is 10 s long: ten and a hundred periods, in which the height
// goes from 0 to -0.03 m and back.
TEST(ContactFigures, bands_have_the_deviation_of_the_waves_in_them)
{
  std::vector<double> times;
  const ContactRecord record = waves(times);
  StatisticsParameters parameters;
  parameters.window = {50., 149.99};
  const ContactFigures f = ContactFigures::of(record, times, parameters);
  for (const ContactFigures::Band &band : f.bands)
  {
    EXPECT_TRUE(band.is_resolved);
    const double slow = band.from < 1. ? 8. : 0., fast = band.to > 10. ? 4. : 0.;
    EXPECT_NEAR(band.deviation, std::hypot(slow, fast) / std::sqrt(2.), 2e-2)
        << band.from << " to " << band.to << " Hz";
  }
  EXPECT_NEAR(f.height_range, .03, 1e-9);
}

// Two contacts with 100 N and opposite waves of 8 N at 5 Hz, and equal ones of 3 N at 20 Hz, for 20
// s at 1 ms. Expected: the slow waves cancel, and the fast ones are twice as large, damped by the
// filter.
TEST(ContactFigures, a_sum_has_the_waves_of_its_contacts)
{
  std::vector<double> times;
  ContactRecord one, two;
  for (int i = 0; i <= 20000; ++i)
  {
    const double t = 1e-3 * i, slow = 8. * std::sin(10. * pi * t),
                 fast = 3. * std::sin(40. * pi * t);
    times.push_back(t);
    one.position.push_back(10. * t);
    two.position.push_back(10. * t - 50.);
    one.force.push_back(100. + slow + fast);
    two.force.push_back(100. - slow + fast);
  }
  one.mean_force = one.force;
  two.mean_force = two.force;
  StatisticsParameters parameters;
  parameters.window = {50., 149.99};
  const ContactQuantities f = ContactQuantities::of(sum_of({one, two}), times, parameters);
  EXPECT_EQ(f.n_samples, 10000u);
  EXPECT_TRUE(f.is_filtered);
  EXPECT_NEAR(f.filtered.mean, 200., 1e-6);
  EXPECT_NEAR(f.filtered.deviation, 6. * damping(20., 20.) / std::sqrt(2.), 2e-2);
  EXPECT_NEAR(f.raw.deviation, 6. / std::sqrt(2.), 1e-9);
  EXPECT_NEAR(f.raw.maximum, 206., .1);
  EXPECT_NEAR(f.raw.minimum, 194., .1);
}

// Expected by hand: both are open in one sample of five.
TEST(ContactFigures, a_sum_is_lost_where_all_its_contacts_are_open)
{
  StatisticsParameters parameters;
  parameters.filter_frequency = 0.;
  const ContactRecord one = {{0., 1., 2., 3., 4.}, {0., 10., 0., 0., 30.}, {0., 10., 0., 0., 40.}},
                      two = {{9., 9., 9., 9., 9.}, {20., 0., 0., 5., 10.}, {20., 0., 0., 5., 10.}};
  const ContactQuantities f =
      ContactQuantities::of(sum_of({one, two}), {0., 1., 2., 3., 4.}, parameters);
  EXPECT_NEAR(f.loss, .2, 1e-12);
  EXPECT_NEAR(f.raw.mean, 15., 1e-12);
  EXPECT_NEAR(f.raw.deviation, std::sqrt((25. + 25. + 225. + 100. + 625.) / 5.), 1e-12);
  EXPECT_EQ(f.raw.minimum, 0.);
  EXPECT_EQ(f.raw.maximum, 50.);
}

TEST(ContactFigures, sums_name_contacts_strips_and_their_links)
{
  const std::vector<SlidingContact> contacts = {
      {"head", {0}, {"head"}}, {"strip", {1, 2}, {"strip on a", "strip on b"}, true}};
  const std::vector<ContactSum> sums =
      contact_sums({"all: head + strip", "part: strip on b+head"}, contacts);
  ASSERT_EQ(sums.size(), 2u);
  EXPECT_EQ(sums[0].name, "all");
  ASSERT_EQ(sums[0].parts.size(), 3u);
  EXPECT_EQ(sums[0].parts[2].contact, 1u);
  EXPECT_EQ(sums[0].parts[2].wire, 1u);
  ASSERT_EQ(sums[1].parts.size(), 2u);
  EXPECT_EQ(sums[1].parts[0].wire, 1u);
  for (const std::vector<std::string> &bad :
       std::vector<std::vector<std::string>>{{"head + strip"},
                                             {": head"},
                                             {"all: head +"},
                                             {"all: head + strp"},
                                             {"all: strip + strip on a"},
                                             {"all: head", "all: strip"}})
    EXPECT_THROW(contact_sums(bad, contacts), EntryError) << bad[0];
}

// Expected: four losses of 4, 6, 12 and 30 samples of 1 ms.
TEST(ContactFigures, losses_are_counted_by_their_duration)
{
  std::vector<double> times;
  ContactRecord record;
  const auto touch = [&](const int n, const double force)
  {
    for (int i = 0; i < n; ++i)
    {
      times.push_back(1e-3 * times.size());
      record.position.push_back(0.);
      record.force.push_back(force);
    }
  };
  for (const int n : {4, 6, 12, 30})
  {
    touch(20, 50.);
    touch(n, 0.);
  }
  touch(68, 50.);
  record.mean_force = record.force;
  EXPECT_EQ(lengths_of_losses(record.force), (std::vector<std::size_t>{4, 6, 12, 30}));
  const ContactFigures f = ContactFigures::of(record, times, {});
  const std::size_t number[] = {3, 2, 1};
  const double share[] = {48. / 200., 42. / 200., 30. / 200.};
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_EQ(f.losses[i].number, number[i]);
    EXPECT_NEAR(f.losses[i].share, share[i], 1e-12);
  }
}

TEST(ContactFigures, a_histogram_counts_each_sample_once)
{
  const Histogram h = histogram({-3., 0., 9.99, 10., 25.}, 10.);
  EXPECT_EQ(h.begin, -10.);
  EXPECT_EQ(h.number, (std::vector<std::size_t>{1, 2, 1, 1}));
  EXPECT_TRUE(histogram({}, 10.).number.empty());
}

// Parseval: the density times the interval of frequencies sums up to the variance. Expected of a
// wave with whole periods in a segment: half its squared amplitude, at its frequency.
TEST(ContactFigures, the_spectrum_sums_up_to_the_variance)
{
  const double step = 1e-3, frequency = 40. / (1024. * step);
  std::vector<double> record;
  for (int i = 0; i < 2048; ++i)
    record.push_back(100. + 6. * std::sin(2. * pi * frequency * step * i));
  const PowerSpectrum s = power_spectrum(record, step);
  ASSERT_EQ(s.frequency.size(), 1025u);
  double sum = 0.;
  std::size_t largest = 0;
  for (std::size_t k = 0; k < s.density.size(); ++k)
  {
    sum += s.density[k] * s.frequency[1];
    if (s.density[k] > s.density[largest])
      largest = k;
  }
  EXPECT_NEAR(sum, 18., 1e-9);
  EXPECT_NEAR(s.frequency[largest], frequency, 1e-9);
  EXPECT_NEAR(s.frequency.back(), 500., 1e-9);
  EXPECT_TRUE(power_spectrum({1., 2.}, step).density.empty());
}

// Of records of any length, with a trend and a peak at their ends, which no window covers.
// Expected: the variance by its definition; the squares of bands without gaps add up to it.
TEST(ContactFigures, spectra_of_records_of_any_length_have_their_variance)
{
  for (const int n : {4, 7, 63, 64, 65, 1000, 1740})
  {
    std::vector<double> record;
    for (int i = 0; i < n; ++i)
      record.push_back(60. + .1 * i + 9. * std::cos(.3 * i) + (i + 2 > n ? 40. : 0.));
    const PowerSpectrum s = power_spectrum(record, 5e-3);
    double sum = 0.;
    for (const double density : s.density)
      sum += density * s.frequency[1];
    const double variance = variance_of(record);
    EXPECT_NEAR(sum, variance, 1e-12 * variance) << n;
    double bands = 0.;
    const double limits[] = {0., 2., 5., 20., 33.3, 100.};
    for (int i = 0; i < 5; ++i)
      bands += std::pow(s.deviation(limits[i], limits[i + 1]), 2);
    EXPECT_NEAR(bands, variance, 1e-12 * variance) << n;
  }
  // What does not change has no density.
  EXPECT_EQ(power_spectrum(std::vector<double>(50, 3.), 1.).deviation(0., 1.), 0.);
}

// Source: the example of rainflow counting in ASTM E1049-85 (figure 6): half a cycle of 3, 6 and 9,
// one and a half of 4, one of 8.
TEST(ContactFigures, rainflow_cycles_are_those_of_the_example_of_the_standard)
{
  std::map<double, double> counts;
  for (const LoadCycle &cycle : rainflow({-2., 1., -3., 5., -1., 3., -4., 4., -2.}))
    counts[cycle.range] += cycle.count;
  EXPECT_EQ(counts, (std::map<double, double>{{3., .5}, {4., 1.5}, {6., .5}, {8., 1.}, {9., .5}}));

  // The same with values between the reversals, and some twice.
  EXPECT_EQ(reversals({-2., -1., 1., 1., 0., -3., 5., 2., -1., 3., 3.}),
            (std::vector<double>{-2., 1., -3., 5., -1., 3.}));
  EXPECT_TRUE(rainflow({1.}).empty());
}

// Expected: 10 N for 1 s, 0 for 2 s, 40 N for 1 s, 0 for 1 s: mean 10 N, and of the squares 340
// N^2.
TEST(ContactFigures, droppers_have_extremes_spread_and_slackenings)
{
  LinkForce force;
  force.keeps_reversals = true;
  force.start(10.);
  for (const auto &[value, dt] :
       {std::make_pair(10., 1.), {0., .5}, {0., 1.5}, {40., 1.}, {0., 1.}})
    force.add(value, dt);
  EXPECT_EQ(force.least, 0.);
  EXPECT_EQ(force.largest, 40.);
  EXPECT_EQ(force.n_slackenings, 2u);
  EXPECT_NEAR(force.mean, 10., 1e-12);
  EXPECT_NEAR(force.deviation(), std::sqrt(340. - 100.), 1e-12);
  EXPECT_EQ(force.reversals, (std::vector<double>{10., 0., 40., 0.}));
}

// Expected: a v^2 + b with v in km/h, of the part of the curve that the speed is in.
TEST(ContactFigures, limits_of_the_mean_force_are_those_of_the_speed)
{
  StatisticsParameters parameters;
  EXPECT_TRUE(parameters.mean_force_range(50.).empty());
  parameters.least_mean = {1e-3, 50.};
  parameters.largest_mean = {1e-3, 100., 180., 2e-3, 60.};
  EXPECT_NO_THROW(parameters.check());
  const std::vector<double> slow = parameters.mean_force_range(100. / 3.6),
                            fast = parameters.mean_force_range(200. / 3.6);
  EXPECT_NEAR(slow[0], 60., 1e-9);
  EXPECT_NEAR(slow[1], 110., 1e-9);
  EXPECT_NEAR(fast[0], 90., 1e-9);
  EXPECT_NEAR(fast[1], 140., 1e-9);
  parameters.least_mean = {1e-3};
  EXPECT_THROW(parameters.check(), EntryError);
}

// Expected: the formulas of the supplies by hand, in N at km/h; an own curve goes before them.
TEST(ContactFigures, supplies_have_their_largest_mean_force)
{
  StatisticsParameters parameters;
  const auto largest = [&](const double v) { return parameters.mean_force_range(v / 3.6).at(1); };
  EXPECT_EQ(parameters.source_of_largest_mean(), "");
  parameters.supply = "AC";
  EXPECT_NEAR(largest(160.), 102.032, 1e-9);
  EXPECT_NEAR(largest(200.), 108.8, 1e-9);
  EXPECT_NEAR(largest(300.), 157.3, 1e-9);
  EXPECT_NE(parameters.source_of_largest_mean().find("check against your edition"),
            std::string::npos);
  for (const auto &[supply, force] : {std::pair("DC 3 kV", 197.3), {"DC 1.5 kV", 227.3}})
  {
    parameters.supply = supply;
    EXPECT_NEAR(largest(300.), force, 1e-9);
    EXPECT_TRUE(parameters.mean_force_range(160. / 3.6).empty());
    EXPECT_TRUE(parameters.mean_force_range(199.9 / 3.6).empty());
  }
  parameters.largest_mean = {0., 99.};
  EXPECT_NEAR(largest(300.), 99., 1e-9);
  EXPECT_EQ(parameters.source_of_largest_mean(), "");
}
