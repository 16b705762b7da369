#include "conformance/report.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "conformance/html.h"
#include "conformance/report_function.h"

namespace sheen::conformance {
namespace {

std::string number(double value, int digits = 3) {
  return html_number(value, digits);
}

std::string number(const glm::dvec3& v) {
  return number(v.x, 4) + " " + number(v.y, 4) + " " + number(v.z, 4);
}

std::size_t count(const RunRecord& record, Status status) {
  return static_cast<std::size_t>(
      std::count_if(record.cases.begin(), record.cases.end(), [status](const CaseResult& c) { return c.status == status; }));
}

std::string fact(const std::string& name, const std::string& value) {
  return value.empty() ? "" : "<div><dt>" + name + "</dt><dd>" + escape_html(value) + "</dd></div>";
}

std::string header(const RunRecord& record) {
  const Hello& viewer = record.viewer;
  std::string html =
      "<h1>sheen-cts: suite " + escape_html(record.suite) + "</h1><p>" + escape_html(record.description) + "</p><dl class=facts>";
  html += fact("Viewer", viewer.name + " " + viewer.version) + fact("Command", record.viewer_command);
  html += fact("Driver", viewer.renderer) + fact("Context", viewer.context_version);
  html += fact("Sub-pixel bits", std::to_string(viewer.subpixel_bits));
  html += viewer.mediump_bits ? fact("Fraction bits of mediump", std::to_string(*viewer.mediump_bits)) : "";
  html += fact("Cases", std::to_string(record.cases.size())) + fact("Seconds", number(record.seconds));
  html += fact("Approximations", record.strict ? "count as failures (strict)" : "count as passed");
  html += "</dl><div class=bar>";
  for (const Status status : statuses) {
    const std::string word = to_string(status);
    if (count(record, status) > 0) {
      html += "<i style=\"flex:" + std::to_string(count(record, status)) + ";background:var(--" + word + ")\" title=\"" + word + "\"></i>";
    }
  }
  std::vector<std::pair<std::string, std::size_t>> counts;
  counts.reserve(statuses.size());
  for (const Status status : statuses) {
    counts.emplace_back(to_string(status), count(record, status));
  }
  return html + "</div>" + html_filters(record.cases.size(), counts);
}

/// A picture with a ring around the worst pixel, if it has one.
std::string picture(const std::vector<std::uint8_t>& png, const std::string& caption, const std::string& ring) {
  const std::string inside =
      png.empty() ? "<div class=none>none</div>"
                  : "<span class=frame><img alt=\"" + caption + "\" src=\"data:image/png;base64," + base64(png) + "\">" + ring + "</span>";
  return "<figure>" + inside + "<figcaption>" + caption + "</figcaption></figure>";
}

/// @param width, height  of the picture, for the ring's place
std::string ring_at(const Verdict& verdict, double width, double height) {
  if (verdict.worst_x < 0 || verdict.bound_ratio <= 1) {
    return "";
  }
  return "<b style=\"left:" + number(100 * (verdict.worst_x + 0.5) / width, 4) +
         "%;top:" + number(100 * (verdict.worst_y + 0.5) / height, 4) + "%\"></b>";
}

std::string figure(const std::string& name, const std::string& value) {
  return "<span>" + name + " <b>" + value + "</b></span>";
}

/// "1205 (1200 at edges, 5 of masks)"
std::string excluded(const Verdict& verdict) {
  constexpr std::array<const char*, 5> reasons = {nullptr, "at edges", "of masks", "of textures", "unpromised"};
  std::string parts;
  for (std::size_t reason = 1; reason < reasons.size(); ++reason) {
    if (verdict.excluded_by.at(reason) > 0) {
      parts += (parts.empty() ? "" : ", ") + std::to_string(verdict.excluded_by.at(reason)) + " " + reasons.at(reason);
    }
  }
  return std::to_string(verdict.excluded_pixels) + (parts.empty() ? "" : " (" + parts + ")");
}

std::string figures(const CaseResult& one) {
  std::string html = "<div class=figures>" + figure("model", escape_html(one.model));
  if (one.verdict) {
    const Verdict& v = *one.verdict;
    html += figure(one.scenes.empty() ? "error / bound" : "deviation / tolerance", number(v.bound_ratio)) +
            figure("max abs", number(v.max_abs)) + figure("max rel", number(v.max_rel)) + figure("p99 rel", number(v.p99_rel)) +
            figure("compared", std::to_string(v.compared_pixels)) + figure("excluded", excluded(v));
    if (v.median_bound > 0) {
      html += figure("median bound", number(v.median_bound));
    }
    if (v.negative_pixels > 0) {
      html += figure("negative", std::to_string(v.negative_pixels));
    }
    if (v.vague_pixels > 0) {
      html += figure("vague", std::to_string(v.vague_pixels));
    }
    if (v.nonfinite_pixels > 0) {
      html += figure("NaN or Inf", std::to_string(v.nonfinite_pixels));
    }
  }
  return html + figure("seconds", number(one.seconds)) + "</div>";
}

std::string light_table(const golden::PixelTerms& terms) {
  std::string html =
      "<table>" + html_row({"light", "N.L", "N.H", "D", "V N.L", "E(N.L)", "scale s", "coat D Vis", "sheen", "base", "coat"}, "th");
  for (const golden::LightTerms& light : terms.lights) {
    html += html_row({std::to_string(light.light), number(light.n_dot_l, 4), number(light.n_dot_h, 4), number(light.d, 4),
                      number(light.v, 4), number(light.e_l, 4), number(light.scale, 4), number(light.coat_lobe, 4), number(light.sheen),
                      number(light.base), number(light.coat)});
  }
  return html + "</table>";
}

std::string point_table(const golden::PixelTerms& terms) {
  std::string html = "<table>";
  html += html_row({"golden radiance", number(terms.radiance)}) + html_row({"emission", number(terms.emission)});
  html += html_row({"N.V", number(terms.n_dot_v, 5)}) + html_row({"E(N.V)", number(terms.e_v, 5)}) +
          html_row({"coat weight k", number(terms.coat_weight, 5)});
  html += html_row({"base colour", number(terms.base_color)}) +
          html_row({"metallic, roughness", number(terms.metallic, 4) + ", " + number(terms.roughness, 4)});
  html += html_row({"sheen colour, roughness", number(terms.sheen_color) + ", " + number(terms.sheen_roughness, 4)});
  html += html_row({"clearcoat, roughness", number(terms.clearcoat, 4) + ", " + number(terms.clearcoat_roughness, 4)});
  return html + "</table>";
}

std::string fit_table(const Diagnosis& diagnosis) {
  if (diagnosis.fits.empty()) {
    return "";
  }
  std::string html = "<table>" + html_row({"if this term were off", "by a factor of", "this relative error would be left"}, "th");
  html += html_row({"none", "1", number(diagnosis.residual)});
  for (const TermFit& fit : diagnosis.fits) {
    html += html_row({fit.term, number(fit.factor, 5), number(fit.residual)});
  }
  return html + "</table>";
}

std::string terms(const CaseResult& one) {
  std::string html;
  if (one.diagnosis && one.diagnosis->terms.covered) {
    const Diagnosis& d = *one.diagnosis;
    html = "<details" + std::string(one.status == Status::Fail ? " open" : "") + "><summary>terms of the worst pixel (" +
           std::to_string(d.x) + ", " + std::to_string(d.y) + ")</summary>" + fit_table(d) + point_table(d.terms) + light_table(d.terms) +
           "</details>";
  }
  html +=
      "<details><summary>" + std::string(one.findings ? "arguments" : "scene") + "</summary><code>" + escape_html(one.scene_file.string());
  for (const ScenePicture& scene : one.scenes) {
    html += escape_html(scene.label + ": " + scene.scene_file.string()) + "<br>";
  }
  return html + "</code></details>";
}

/// A case's candidate beside its golden, or a relation's scenes side by side; then how far they are apart.
std::string pictures(const CaseResult& one) {
  const std::string ring = one.verdict ? ring_at(*one.verdict, one.width, one.height) : "";
  std::string html = "<div class=pictures>";
  for (const ScenePicture& scene : one.scenes) {
    html += picture(scene.png, escape_html(scene.label), ring);
  }
  if (one.scenes.empty()) {
    html += picture(one.pictures.candidate, "candidate", ring) + picture(one.pictures.golden, "golden", ring);
  }
  return html + picture(one.pictures.difference, one.scenes.empty() ? "error / bound" : "difference / tolerance", ring) + "</div>";
}

std::string card(const CaseResult& one) {
  const std::string word = to_string(one.status);
  std::string html = "<article" + std::string(one.findings ? " class=function" : "") + " data-status=" + word + " data-name=\"" +
                     escape_html(one.name) + "\" style=\"--status:var(--" + word + ")\">";
  html += one.findings ? function_pictures(*one.findings) : pictures(one);
  html += "<div><h2><span class=badge>" + word + "</span>" + escape_html(one.name) + "</h2>";
  // A message about a broken law quotes it.
  html += one.law.empty() || one.message.find(one.law) != std::string::npos ? "" : "<p class=law>" + escape_html(one.law) + "</p>";
  if (!one.message.empty()) {
    html += "<p class=message>" + escape_html(one.message) + "</p>";
  }
  if (!one.identified.empty()) {
    html += "<p class=message>identified: " + escape_html(one.identified) + "</p>";
  }
  return html + figures(one) + terms(one) + "</div></article>\n";
}

}  // namespace

std::string base64(const std::vector<std::uint8_t>& bytes) {
  static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = (group << 8) | (k < left ? bytes[i + k] : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += k <= left ? digits[(group >> (18 - 6 * k)) & 63U] : '=';
    }
  }
  return text;
}

std::string escape_html(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    switch (c) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      case '\'':
        safe += "&#39;";
        break;
      default:
        safe += c;
    }
  }
  return safe;
}

std::string report_html(const RunRecord& record) {
  std::string cards = formulation_table(record);
  for (const Status status : statuses) {
    for (const CaseResult& one : record.cases) {
      if (one.status == status) {
        cards += card(one);
      }
    }
  }
  return html_page("sheen-cts: " + record.suite, "", header(record), cards);
}

}  // namespace sheen::conformance
