// Draws the charts of a report when they come to sight, and keeps equal choices on the page together.
"use strict";
(() => {
  const config = {
    responsive: true, displaylogo: false, modeBarButtonsToRemove: ["select2d", "lasso2d", "autoScale2d"],
    toImageButtonOptions: { format: "svg" },
  };

  // Texts that name a colour of the style sheet become that colour; "--ink/20" is a fifth of it, the rest is clear.
  const colour = (text, style) => {
    const [name, percent] = text.split("/");
    const alpha = percent === undefined ? "" : Math.round(2.55 * percent).toString(16).padStart(2, "0");
    return style.getPropertyValue(name).trim() + alpha;
  };
  const coloured = (value, style) => {
    if (typeof value === "string") return value.startsWith("--") ? colour(value, style) : value;
    if (Array.isArray(value)) return value.map((one) => (typeof one === "number" ? one : coloured(one, style)));
    if (value === null || typeof value !== "object") return value;
    return Object.fromEntries(Object.entries(value).map(([key, one]) => [key, coloured(one, style)]));
  };

  const axis = (own) => ({
    gridcolor: "--rule", zerolinecolor: "--rule", linecolor: "--rule", tickcolor: "--rule", ticks: "outside", ticklen: 4,
    automargin: true, ...own, title: { standoff: 8, font: { size: 12.5, color: "--ink" }, ...own.title },
  });

  const styled = (layout) => {
    const axes = Object.entries(layout).filter(([key]) => /^[xy]axis\d*$/.test(key));
    return {
      font: { family: getComputedStyle(document.body).fontFamily, size: 12, color: "--soft" },
      paper_bgcolor: "--sheet", plot_bgcolor: "--sheet", margin: { l: 64, r: 18, t: 34, b: 44 }, hovermode: "closest",
      legend: { orientation: "h", x: 0, y: 1, yanchor: "bottom", font: { size: 12 } },
      hoverlabel: { bgcolor: "--paper", bordercolor: "--rule", font: { color: "--ink" } },
      ...layout, ...Object.fromEntries(axes.map(([key, own]) => [key, axis(own)])),
    };
  };

  const draw = (chart) => {
    const { data, layout } = JSON.parse(chart.nextElementSibling.textContent);
    const style = getComputedStyle(document.documentElement);
    Plotly.react(chart, coloured(data, style), coloured(styled(layout), style), config);
    chart.dataset.drawn = "";
  };
  const charts = () => [...document.querySelectorAll(".chart")];
  const visible = (chart) => chart.offsetParent !== null;
  const drawVisible = () => charts().filter((chart) => visible(chart) && !("drawn" in chart.dataset)).forEach(draw);

  const choose = (group, value) => {
    for (const choice of document.querySelectorAll(`.choice[data-group="${group}"]`)) {
      const panels = [...choice.children].filter((child) => "value" in child.dataset);
      if (!panels.some((panel) => panel.dataset.value === value)) continue;
      for (const panel of panels) panel.hidden = panel.dataset.value !== value;
      for (const button of choice.querySelectorAll(":scope > .options > button"))
        button.setAttribute("aria-pressed", String(button.value === value));
      for (const menu of choice.querySelectorAll(":scope > .options > select")) menu.value = value;
    }
    drawVisible();
    // A chart that was drawn while the window had another width.
    for (const chart of charts()) if (visible(chart)) Plotly.Plots.resize(chart);
  };
  for (const options of document.querySelectorAll(".choice > .options")) {
    const { group } = options.parentElement.dataset;
    options.addEventListener("click", ({ target }) => { if (target.matches("button")) choose(group, target.value); });
    options.addEventListener("change", ({ target }) => { if (target.matches("select")) choose(group, target.value); });
  }

  const redraw = () => charts().filter((chart) => "drawn" in chart.dataset).forEach(draw);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);
  drawVisible();
})();
