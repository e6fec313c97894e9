// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/place_plots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "gnuplot.hpp"

namespace panvo::evaluation {
std::vector<LocalCurve> local_curves(const std::vector<const PlaceMethod*>& methods, const PlaceTask& task,
                                     const PlaceRevisit& revisit, const PlaceRecording& first,
                                     const PlaceRecording& then, double reach_m) {
  const auto known = read_panorama(first.panoramas[task.places[revisit.known].panorama]);
  const double middle_m = then.panoramas[revisit.panorama].travelled_m;
  std::vector<LocalCurve> curves;
  std::vector<std::unique_ptr<PlaceDescriptor>> landmarks;
  for (const auto* method : methods) {
    curves.push_back({method->name(), {}, {}});
    landmarks.push_back(method->describe_landmark(known));
  }
  for (const auto& panorama : then.panoramas) {
    const double way_m = panorama.travelled_m - middle_m;
    if (std::abs(way_m) > reach_m) continue;
    const auto image = read_panorama(panorama);
    for (std::size_t i = 0; i < methods.size(); ++i) {
      curves[i].way_m.push_back(way_m);
      const auto query = methods[i]->describe_query(image);
      curves[i].distance.push_back(methods[i]->distance(*query, *landmarks[i]).distance);
    }
  }
  for (auto& curve : curves) {
    const auto [least, most] = std::minmax_element(curve.distance.begin(), curve.distance.end());
    const double low = *least;
    const double span = std::max(*most - low, 1e-12);
    for (auto& value : curve.distance) value = (value - low) / span;
  }
  return curves;
}

void draw_separation(const std::vector<PlaceScore>& scores, const std::filesystem::path& folder) {
  const int columns = std::min<int>(3, static_cast<int>(scores.size()));
  const int rows = (static_cast<int>(scores.size()) + columns - 1) / std::max(columns, 1);
  std::string script = fmt::format(
      "set terminal pngcairo size {},{} font 'sans,10'\nset output 'separation.png'\nset multiplot layout {},{} "
      "title 'Distances of revisits (blue) and of other places (red)'\nset yrange [-0.05:1.05]\nset xlabel 'sample'\n"
      "set ylabel \"D'\"\nset key off\nset grid ytics lc rgb '#dddddd'\n",
      430 * columns, 300 * rows + 40, rows, columns);
  for (std::size_t i = 0; i < scores.size(); ++i) {
    const auto& score = scores[i];
    script += fmt::format("$negatives{} << EOD\n", i);
    for (std::size_t k = 0; k < score.negatives.size(); ++k) {
      script += fmt::format("{} {:.5f}\n", k, score.negatives[k].distance);
    }
    script += fmt::format("EOD\n$positives{} << EOD\n", i);
    for (std::size_t k = 0; k < score.positives.size(); ++k) {
      const double x = score.positives.size() < 2 ? 0.0
                                                  : static_cast<double>(k * (score.negatives.size() - 1)) /
                                                        static_cast<double>(score.positives.size() - 1);
      script += fmt::format("{:.3f} {:.5f} {}\n", x, score.positives[k].distance, score.positives[k].is_right ? 1 : 0);
    }
    script += fmt::format(
        "EOD\nset title {}\nplot $negatives{} using 1:2 with points pt 2 lc rgb '#c03028', $positives{} using 1:($3 > "
        "0 ? "
        "$2 : NaN) with points pt 7 lc rgb '#2050a0', $positives{} using 1:($3 > 0 ? NaN : $2) with points pt 6 lc rgb "
        "'#2050a0'\n",
        gnuplot_quoted(fmt::format("{}: V_sc {:.2f}, recall {:.2f}, precision {:.2f}", score.method, score.separation,
                                   score.recall, score.precision)),
        i, i, i);
  }
  write_and_run_gnuplot(folder, "separation.gp", script + "unset multiplot\n");
}

void draw_local_curves(const std::vector<LocalCurve>& curves, const std::string& title, int number,
                       const std::filesystem::path& folder) {
  std::string script = fmt::format(
      "set terminal pngcairo size 900,460 font 'sans,10'\nset output 'local_{}.png'\nset title {}\nset xlabel "
      "'travelled from the nearest point (m)'\nset ylabel 'normalised distance'\nset yrange [-0.05:1.05]\nset key "
      "outside right\n"
      "set grid lc rgb '#dddddd'\n",
      number, gnuplot_quoted(title));
  std::string plot;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    script += fmt::format("$curve{} << EOD\n", i);
    for (std::size_t k = 0; k < curves[i].way_m.size(); ++k) {
      script += fmt::format("{:.3f} {:.5f}\n", curves[i].way_m[k], curves[i].distance[k]);
    }
    script += "EOD\n";
    plot += fmt::format("{}$curve{} using 1:2 with lines lw 2 title {}", i == 0 ? "plot " : ", ", i,
                        gnuplot_quoted(curves[i].method));
  }
  write_and_run_gnuplot(folder, fmt::format("local_{}.gp", number), script + plot + "\n");
}

}  // namespace panvo::evaluation
