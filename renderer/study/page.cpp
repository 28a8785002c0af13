#include "renderer/study/page.h"

#include <fmt/format.h>

#include <cmath>

#include "renderer/api/version.h"
#include "renderer/study/folder.h"

namespace rondure {
namespace {

constexpr const char* style = R"(
body { font: 15px/1.5 sans-serif; max-width: 68em; margin: 2em auto; padding: 0 1em; color: #1c1c1c; }
h1, h2, h3 { line-height: 1.2; }
h2 { border-bottom: 1px solid #bbb; padding-bottom: 0.2em; margin-top: 2em; }
code { background: #f2f2ee; padding: 0.1em 0.3em; overflow-wrap: anywhere; }
table { border-collapse: collapse; margin: 1em 0; font-size: 13px; }
td, th { padding: 0.2em 0.6em; text-align: right; border-bottom: 1px solid #ddd; vertical-align: top; }
td:first-child, th:first-child { text-align: left; }
figure { margin: 1em 0; }
figcaption { font-size: 13px; color: #444; max-width: 60em; }
.pair { display: flex; gap: 4px; align-items: flex-start; min-width: 200px; }
img { image-rendering: pixelated; display: block; }
svg { max-width: 100%; height: auto; }
)";

}  // namespace

std::string html_page(const std::string& title, const std::string& command, const std::string& body) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>{}</title>\n"
      "<style>{}</style>\n</head>\n<body>\n<h1>{}</h1>\n<p>Made by Rondure {} with <code>{}</code>.</p>\n{}\n"
      "</body>\n</html>\n",
      html_escaped(title), style, html_escaped(title), version, html_escaped(command), body);
}

std::string html_table(const std::vector<std::vector<std::string>>& rows) {
  std::string out = "<table>\n";
  for (const auto& row : rows) {
    const char* cell = &row == &rows.front() ? "th" : "td";
    out += "<tr>";
    for (const std::string& text : row) out += fmt::format("<{0}>{1}</{0}>", cell, text);
    out += "</tr>\n";
  }
  return out + "</table>\n";
}

std::string html_figure(const std::string& content, const std::string& caption) {
  return fmt::format("<figure>\n{}\n<figcaption>{}</figcaption>\n</figure>\n", content, caption);
}

std::string html_picture(const std::string& png, const std::string& alt) {
  return fmt::format("<img alt=\"{}\" src=\"data:image/png;base64,{}\">", html_escaped(alt), base64(png));
}

std::string number_text(double x, int digits) {
  return std::isnan(x) ? "-" : fmt::format("{:.{}g}", x, digits);
}

}  // namespace rondure
