// Finds faults of layout. It runs inside the page and returns a list of complaints: elements wider
// than the window, text that is cut off, letters that are small or pale.
export const complaints = ({ onPaper }) => {
  const found = new Set();
  const complain = (what, element, more = "") => {
    const words = element.textContent.trim().replace(/\s+/g, " ").slice(0, 50);
    found.add(`${what}${more}: <${element.localName} class="${element.getAttribute("class") ?? ""}"> ${words}`);
  };
  const width = document.documentElement.clientWidth;
  if (document.documentElement.scrollWidth > width) found.add(`the page is ${document.documentElement.scrollWidth} wide, the window ${width}`);

  // What may hide parts of its content, because it scrolls and says so or is seen to do so.
  const mayHide = (element, axis) =>
    !onPaper && (axis === "x" ? element.matches(".scroll.is-wide") : element.matches(".list, .printed"));
  const clips = (style, axis) => style[axis === "x" ? "overflowX" : "overflowY"] !== "visible";

  // Whether a box is seen as a whole, as far as the boxes around it are concerned.
  const isCut = (element, box) => {
    let inX = true;
    for (let at = element; at !== document.body; at = at.parentElement ?? document.body) {
      const style = getComputedStyle(at);
      const around = at.getBoundingClientRect();
      if (mayHide(at, "x")) inX = false;
      const out = { x: box.left < around.left - 1 || box.right > around.right + 1, y: box.top < around.top - 1 || box.bottom > around.bottom + 1 };
      for (const axis of ["x", "y"]) if (clips(style, axis) && out[axis] && !mayHide(at, axis)) return true;
      if (mayHide(at, "y")) return false;
    }
    return inX && (box.left < -1 || box.right > width + 1);
  };

  // What is folded has its place, but is not seen.
  const isSeen = (element) => element.checkVisibility({ visibilityProperty: true });

  const channels = (text) => {
    const [r, g, b, a = 1] = text.match(/[\d.]+/g).map(Number);
    return { r, g, b, a };
  };
  const over = (top, under) => {
    const mix = (k) => top.a * top[k] + (1 - top.a) * under[k];
    return { r: mix("r"), g: mix("g"), b: mix("b"), a: 1 };
  };
  const groundOf = (element) => {
    const layers = [];
    for (let at = element; at; at = at.parentElement) {
      const layer = channels(getComputedStyle(at).backgroundColor);
      layers.push(layer);
      if (layer.a === 1) break;
    }
    return layers.reverse().reduce((under, layer) => over(layer, under), { r: 255, g: 255, b: 255, a: 1 });
  };
  const light = ({ r, g, b }) => {
    const [x, y, z] = [r, g, b].map((c) => (c / 255 <= 0.04045 ? c / 255 / 12.92 : ((c / 255 + 0.055) / 1.055) ** 2.4));
    return 0.2126 * x + 0.7152 * y + 0.0722 * z;
  };
  const contrast = (a, b) => {
    const [high, low] = [light(a), light(b)].sort((x, y) => y - x);
    return (high + 0.05) / (low + 0.05);
  };

  const walker = document.createTreeWalker(document.getElementById("page"), NodeFilter.SHOW_TEXT);
  while (walker.nextNode()) {
    const node = walker.currentNode;
    const element = node.parentElement;
    const range = document.createRange();
    range.selectNodeContents(node);
    const boxes = [...range.getClientRects()].filter((box) => box.width > 0 && box.height > 0);
    // Labels in the 3D picture move with it, and have a rim of their own.
    if (node.textContent.trim() === "" || boxes.length === 0 || element.closest(".marks, select, .aside")) continue;
    if (!isSeen(element)) continue;
    const style = getComputedStyle(element);
    if (boxes.some((box) => isCut(element, box))) complain("cut", element);
    const size = parseFloat(style.fontSize);
    if (size < 11) complain("small", element, ` (${size})`);
    const ground = groundOf(element);
    const ratio = contrast(over(channels(style.color), ground), ground);
    const isLarge = size >= 24 || (size >= 18.66 && Number(style.fontWeight) >= 700);
    if (ratio < (isLarge ? 3 : 4.5)) complain("pale", element, ` (${ratio.toFixed(2)})`);
  }
  for (const element of document.querySelectorAll(".bar, .dot, .limit, .share")) {
    const ground = groundOf(element.parentElement);
    const ratio = contrast(groundOf(element), ground);
    if (isSeen(element) && ratio < 3) complain("pale", element, ` (${ratio.toFixed(2)})`);
  }
  for (const element of document.querySelectorAll("img, table, canvas, .plot, .shares")) {
    if (isSeen(element) && isCut(element, element.getBoundingClientRect())) complain("cut", element);
  }
  return [...found];
};
