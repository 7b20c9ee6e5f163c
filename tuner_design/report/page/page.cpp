// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/report/page/page.h"

#include "tuner_design/report/page/html_table.h"
#include "tuner_design/report/page/page_style.h"
#include "tuner_design/report/page/text.h"

namespace ehm::tuner_design::report {
namespace {

std::string download(const std::string& id, const std::string& title, const DataTable& table) {
  return "<a class=\"csv\" download=\"" + id + ".csv\" href=\"" + csv_link(table) + "\" aria-label=\"" +
         escaped("Numbers of: " + title) + "\">CSV</a>";
}

std::string contents(const std::vector<Section>& sections) {
  std::string html = "<nav aria-label=\"Contents\"><ol>";
  for (const Section& section : sections)
    html += "<li><a href=\"#" + section.id + "\">" + escaped(section.title) + "</a></li>";
  return html + "</ol></nav>\n";
}

}  // namespace

void Section::add_text(const std::string& text) {
  html += "<p>" + escaped(text) + "</p>\n";
}

void Section::add_key_figures(const std::vector<KeyFigure>& figures) {
  html += "<dl class=\"key\">";
  for (const KeyFigure& figure : figures) {
    html += "<div><dt>" + escaped(figure.meaning) + "</dt><dd>" + escaped(figure.value);
    if (!figure.unit.empty()) html += " <span class=\"unit\">" + escaped(figure.unit) + "</span>";
    html += "</dd></div>";
  }
  html += "</dl>\n";
}

void Section::add_figure(const std::string& figure_id, const std::string& figure_title, const std::string& reading,
                         const std::string& body, DataTable table) {
  html += "<figure id=\"" + figure_id + "\"><figcaption><strong>" + escaped(figure_title) + "</strong> " +
          escaped(reading) + " " + download(figure_id, figure_title, table) + "</figcaption>" + body + "</figure>\n";
  data.emplace_back(figure_id, std::move(table));
}

void Section::add_table(const std::string& table_id, const std::string& caption, DataTable table, std::size_t totals) {
  html += "<div class=\"table\" id=\"" + table_id + "\">" + html_table(table, caption, totals) + "<p class=\"below\">" +
          download(table_id, caption, table) + "</p></div>\n";
  data.emplace_back(table_id, std::move(table));
}

std::string to_html(const Page& page) {
  std::string html =
      "<!DOCTYPE html>\n<html xmlns=\"http://www.w3.org/1999/xhtml\" lang=\"en\">\n<head>\n"
      "<meta charset=\"utf-8\"/>\n<meta name=\"viewport\" content=\"width=device-width, "
      "initial-scale=1\"/>\n<meta name=\"color-scheme\" content=\"light dark\"/>\n<title>" +
      escaped(page.title + ": " + page.kind) + "</title>\n<style>\n" + page_style +
      "</style>\n</head>\n<body>\n<header><p class=\"kicker\">" + escaped(page.kind) + "</p><h1>" +
      escaped(page.title) + "</h1><p class=\"subtitle\">" + escaped(page.subtitle) + "</p></header>\n" +
      contents(page.sections) + "<main>\n";
  for (const Section& section : page.sections) {
    html +=
        "<section id=\"" + section.id + "\"><h2>" + escaped(section.title) + "</h2>\n" + section.html + "</section>\n";
  }
  return html + "</main>\n<footer><p>" + escaped(page.footer) + "</p></footer>\n</body>\n</html>\n";
}

}  // namespace ehm::tuner_design::report
