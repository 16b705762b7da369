#include "conformance/report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "conformance/report_function.h"

namespace sheen::conformance {
namespace {

constexpr std::array<Status, 7> statuses = {Status::Fail,          Status::Crash,       Status::Timeout, Status::Invalid,
                                            Status::Approximation, Status::Unsupported, Status::Pass};

std::string number(double value, int digits = 3) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.*g", digits, value);
  return text.data();
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
      "<header><h1>sheen-cts: suite " + escape_html(record.suite) + "</h1><p>" + escape_html(record.description) + "</p><dl class=facts>";
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
  html += "</div><nav><button data-status=all>all " + std::to_string(record.cases.size()) + "</button>";
  for (const Status status : statuses) {
    const std::string word = to_string(status);
    if (count(record, status) > 0) {
      html += "<button data-status=" + word + " style=\"color:var(--" + word + ")\">" + word + " " + std::to_string(count(record, status)) +
              "</button>";
    }
  }
  return html + "<input type=search placeholder=\"words in the case's name\" aria-label=\"words in the case's name\"></nav></header>";
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

std::string figures(const CaseResult& one) {
  std::string html = "<div class=figures>" + figure("model", escape_html(one.model));
  if (one.verdict) {
    const Verdict& v = *one.verdict;
    html += figure(one.scenes.empty() ? "error / bound" : "deviation / tolerance", number(v.bound_ratio)) +
            figure("max abs", number(v.max_abs)) + figure("max rel", number(v.max_rel)) + figure("p99 rel", number(v.p99_rel)) +
            figure("compared", std::to_string(v.compared_pixels)) + figure("excluded", std::to_string(v.excluded_pixels));
    if (v.vague_pixels > 0) {
      html += figure("vague", std::to_string(v.vague_pixels));
    }
    if (v.nonfinite_pixels > 0) {
      html += figure("NaN or Inf", std::to_string(v.nonfinite_pixels));
    }
  }
  return html + figure("seconds", number(one.seconds)) + "</div>";
}

std::string row(const std::vector<std::string>& cells, const char* tag = "td") {
  std::string html = "<tr>";
  for (const std::string& cell : cells) {
    html += std::string("<") + tag + ">" + cell + "</" + tag + ">";
  }
  return html + "</tr>";
}

std::string light_table(const golden::PixelTerms& terms) {
  std::string html =
      "<table>" + row({"light", "N.L", "N.H", "D", "V N.L", "E(N.L)", "scale s", "coat D Vis", "sheen", "base", "coat"}, "th");
  for (const golden::LightTerms& light : terms.lights) {
    html += row({std::to_string(light.light), number(light.n_dot_l, 4), number(light.n_dot_h, 4), number(light.d, 4), number(light.v, 4),
                 number(light.e_l, 4), number(light.scale, 4), number(light.coat_lobe, 4), number(light.sheen), number(light.base),
                 number(light.coat)});
  }
  return html + "</table>";
}

std::string point_table(const golden::PixelTerms& terms) {
  std::string html = "<table>";
  html += row({"golden radiance", number(terms.radiance)}) + row({"emission", number(terms.emission)});
  html +=
      row({"N.V", number(terms.n_dot_v, 5)}) + row({"E(N.V)", number(terms.e_v, 5)}) + row({"coat weight k", number(terms.coat_weight, 5)});
  html += row({"base colour", number(terms.base_color)}) +
          row({"metallic, roughness", number(terms.metallic, 4) + ", " + number(terms.roughness, 4)});
  html += row({"sheen colour, roughness", number(terms.sheen_color) + ", " + number(terms.sheen_roughness, 4)});
  html += row({"clearcoat, roughness", number(terms.clearcoat, 4) + ", " + number(terms.clearcoat_roughness, 4)});
  return html + "</table>";
}

std::string fit_table(const Diagnosis& diagnosis) {
  if (diagnosis.fits.empty()) {
    return "";
  }
  std::string html = "<table>" + row({"if this term were off", "by a factor of", "this relative error would be left"}, "th");
  html += row({"none", "1", number(diagnosis.residual)});
  for (const TermFit& fit : diagnosis.fits) {
    html += row({fit.term, number(fit.factor, 5), number(fit.residual)});
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
  std::string html =
      "<!DOCTYPE html>\n<html lang=en><head><meta charset=utf-8><meta name=viewport content=\"width=device-width\"><title>sheen-cts: " +
      escape_html(record.suite) + "</title><style>" + report_style + "</style></head><body>\n" + header(record) + "<main>\n" +
      formulation_table(record);
  for (const Status status : statuses) {
    for (const CaseResult& one : record.cases) {
      if (one.status == status) {
        html += card(one);
      }
    }
  }
  return html + "</main><script>" + report_script + "</script></body></html>\n";
}

}  // namespace sheen::conformance
