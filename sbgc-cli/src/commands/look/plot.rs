//! `sbgc plot`: a recording as a picture.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Once;

use clap::Args;
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{FontStyle, register_font};
use sbgc_host::capture::{Captured, Format, Interpreter, Reader};
use sbgc_proto::reflect::{Leaf, Meaning, Raw};

use crate::failure::Failure;
use crate::{files, signals, talk, text};

const EXAMPLES: &str = "Examples:
  sbgc record a.log --for 2s && sbgc plot a.log -o a.svg
  sbgc record a.log --for 2s && sbgc plot a.log -o a.png --fields imu_angles.yaw";

/// Draw a recording as SVG or PNG
///
/// Draws the most frequent message over time, one panel per unit. A capture without times is drawn over the board's
/// own time, or else over the sample number.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Plot {
    /// Recording, or a capture of any format that decode reads
    file: PathBuf,

    /// Picture to write; the format follows from .svg or .png
    #[arg(long, short, value_name = "PICTURE")]
    output: PathBuf,

    /// Fields to draw, by their JSON keys [default: all that change]
    #[arg(long, value_name = "KEYS", value_delimiter = ',')]
    fields: Vec<String>,

    /// Size in pixels
    #[arg(long, value_name = "WxH", default_value = "1200x800", value_parser = size)]
    size: (u32, u32),
}

fn size(text: &str) -> Result<(u32, u32), String> {
    let expected = || format!("expected a size such as 1200x800, 200x150 to 8000x8000, got \"{text}\"");
    let (width, height) = text.split_once(['x', 'X']).ok_or_else(expected)?;
    match (width.parse(), height.parse()) {
        (Ok(width @ 200..=8000), Ok(height @ 150..=8000)) => Ok((width, height)),
        _ => Err(expected()),
    }
}

#[derive(Clone, Copy)]
enum Picture {
    Svg,
    Png,
}

/// Values of one field over time.
#[derive(Default)]
struct Curve {
    path: String,
    unit: &'static str,
    points: Vec<(f64, f64)>,
}

/// All values of one message.
#[derive(Default)]
struct Track {
    name: String,
    samples: usize,
    /// The first sample of the next time, of captures that have none.
    curves: Vec<Curve>,
    index: BTreeMap<String, usize>,
}

/// Curves in one panel; more are hard to tell apart.
const CURVES: usize = 9;
/// Panels in one picture.
const PANELS: usize = 6;

/// Font of the names of curves.
const LEGEND: (&str, i32) = ("sans-serif", 14);
/// Length of the line before a name.
const MARK: i32 = 18;

const TIME: &str = "timestamp_ms";

impl Plot {
    pub(crate) fn run(self) -> Result<(), Failure> {
        let picture = match self.output.extension().and_then(|extension| extension.to_str()) {
            Some(extension) if extension.eq_ignore_ascii_case("svg") => Picture::Svg,
            Some(extension) if extension.eq_ignore_ascii_case("png") => Picture::Png,
            _ => {
                let name = self.output.display();
                return Err(Failure::Usage(format!("{name}: expected a picture ending in .svg or .png")));
            }
        };
        let (tracks, over) = signals::blocking(|| self.read())?;
        let nothing = || Failure::Failed(format!("{}: no samples with numbers found", self.file.display()));
        let wanted = |track: &Track| self.fields.iter().all(|field| track.index.contains_key(field));
        let best = tracks.iter().filter(|track| wanted(track)).max_by_key(|track| track.samples);
        let Some(track) = best else {
            let known: Vec<&str> =
                tracks.iter().flat_map(|track| track.index.keys().map(String::as_str)).collect();
            let missing = self.fields.iter().find(|field| !known.contains(&field.as_str()));
            return Err(match missing {
                _ if known.is_empty() => nothing(),
                Some(field) => Failure::Usage(text::unknown("field", field, known)),
                None => Failure::Usage(String::from("these fields do not belong to one message")),
            });
        };
        let panels = self.panels(track);
        if panels.is_empty() {
            return Err(nothing());
        }
        register_fonts();
        let failed = |reason: String| Failure::Failed(format!("{}: {reason}", self.output.display()));
        match picture {
            Picture::Svg => {
                let mut svg = String::new();
                draw(&SVGBackend::with_string(&mut svg, self.size).into_drawing_area(), track, &panels, over)
                    .map_err(failed)?;
                files::write(&self.output, svg.as_bytes())?;
            }
            Picture::Png => {
                // The backend knows the format by the name, so it gets a name of its own in the same place.
                let new = sibling(&self.output);
                let drawn =
                    draw(&BitMapBackend::new(&new, self.size).into_drawing_area(), track, &panels, over);
                drawn.map_err(failed)?;
                fs::rename(&new, &self.output).map_err(|source| file(&self.output, source))?;
            }
        }
        let (count, name) = (track.samples, &track.name);
        talk::say(format_args!("{count} samples of {name} in {}", self.output.display()));
        Ok(())
    }

    /// All messages of the capture, and what they are drawn over.
    fn read(&self) -> Result<(Vec<Track>, &'static str), Failure> {
        let bytes = fs::read(&self.file).map_err(|source| file(&self.file, source))?;
        let (mut reader, mut items) = (Reader::new(Format::Auto), Vec::new());
        reader.feed(&bytes, &mut |item| items.push(item))?;
        reader.finish(&mut |item| items.push(item))?;
        let timed = items.iter().any(|item| matches!(item, Captured::Frame { time: Some(_), .. }));
        let mut tracks: BTreeMap<(u8, usize), Track> = BTreeMap::new();
        let mut interpreter = Interpreter::new(None);
        let (mut first, mut own_time) = (None, false);
        for item in items {
            let Captured::Frame { time, direction, id, payload, .. } = item else { continue };
            // Requests are read, too: they say what the samples hold.
            let Ok(message) = interpreter.interpret(direction, id, &payload) else { continue };
            if message.direction() == sbgc_proto::Direction::Outgoing {
                continue;
            }
            let track = tracks.entry((id, payload.len())).or_default();
            message.name().unwrap_or("unknown command").clone_into(&mut track.name);
            let mut values = Vec::new();
            message.walk(&mut |leaf: &Leaf<'_>| {
                if let Some(value) = number(leaf) {
                    values.push((leaf.path.to_string(), leaf.unit(), value));
                }
            });
            let board = values.iter().find(|(path, ..)| path == TIME).map(|(_, _, value)| value / 1000.0);
            let at = match (time, board) {
                (Some(time), _) => {
                    let first = *first.get_or_insert(time);
                    time.saturating_sub(first).as_secs_f64()
                }
                (None, Some(board)) if !timed => {
                    own_time = true;
                    board
                }
                #[allow(clippy::cast_precision_loss, reason = "fewer samples than that")]
                _ => track.samples as f64,
            };
            track.samples += 1;
            for (path, unit, value) in values.into_iter().filter(|(path, ..)| path != TIME) {
                let next = track.curves.len();
                let index = *track.index.entry(path.clone()).or_insert(next);
                if index == next {
                    track.curves.push(Curve { path, unit, points: Vec::new() });
                }
                if let Some(curve) = track.curves.get_mut(index).filter(|_| value.is_finite()) {
                    curve.points.push((at, value));
                }
            }
        }
        let over = match (timed, own_time) {
            (true, _) => "time (s)",
            (false, true) => "time of the board (s)",
            (false, false) => "sample",
        };
        Ok((tracks.into_values().collect(), over))
    }

    /// The curves to draw, one panel per unit.
    fn panels<'t>(&self, track: &'t Track) -> Vec<Vec<&'t Curve>> {
        let mut chosen: Vec<&Curve> = if self.fields.is_empty() {
            track.curves.iter().filter(|curve| curve.changes()).collect()
        } else {
            let of_field = |field: &String| track.curves.get(*track.index.get(field)?);
            self.fields.iter().filter_map(of_field).collect()
        };
        if chosen.is_empty() {
            // Nothing moved, which is worth a picture as well.
            chosen = track.curves.iter().filter(|curve| !curve.unit.is_empty()).collect();
        }
        let mut panels: Vec<Vec<&Curve>> = Vec::new();
        for curve in chosen.into_iter().filter(|curve| !curve.points.is_empty()) {
            let fits = |panel: &&mut Vec<&Curve>| {
                panel.len() < CURVES && panel.first().is_some_and(|first| first.unit == curve.unit)
            };
            match panels.iter_mut().find(fits) {
                Some(panel) => panel.push(curve),
                None => panels.push(vec![curve]),
            }
        }
        if panels.len() > PANELS {
            let left: Vec<_> =
                panels.split_off(PANELS).into_iter().flatten().map(|curve| curve.path.as_str()).collect();
            talk::say(format_args!("not drawn: {}; choose with --fields", left.join(", ")));
        }
        panels
    }
}

impl Curve {
    fn changes(&self) -> bool {
        self.points.windows(2).any(|pair| matches!(pair, [(_, one), (_, other)] if (one - other).abs() > 0.0))
    }
}

/// What can be drawn of a field: numbers that are not names or flags.
fn number(leaf: &Leaf<'_>) -> Option<f64> {
    let named = |meaning: &Meaning| matches!(meaning, Meaning::Enum(_) | Meaning::Flags(_));
    match (leaf.raw, leaf.number) {
        (Raw::Number(_), Some(number)) if !leaf.field.reserved && !named(&number.meaning) => leaf.value(),
        _ => None,
    }
}

fn file(path: &Path, source: std::io::Error) -> Failure {
    Failure::File { place: path.display().to_string(), source }
}

/// A new name beside `path`, with the same ending.
fn sibling(path: &Path) -> PathBuf {
    let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or("new");
    path.with_extension(format!("{}.{ending}", std::process::id()))
}

/// The fonts of the system may be none.
fn register_fonts() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        for style in [FontStyle::Normal, FontStyle::Bold] {
            // It is known to be a font.
            let _ = register_font("sans-serif", style, epaint_default_fonts::UBUNTU_LIGHT);
        }
    });
}

/// Colors that can be told apart, also by who sees fewer (Okabe and Ito), the lightest left out.
const COLORS: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(0, 0, 0),
];

fn draw<B: DrawingBackend>(
    area: &DrawingArea<B, Shift>,
    track: &Track,
    panels: &[Vec<&Curve>],
    over: &str,
) -> Result<(), String> {
    draw_all(area, track, panels, over).map_err(|error| error.to_string())
}

fn draw_all<B: DrawingBackend>(
    area: &DrawingArea<B, Shift>,
    track: &Track,
    panels: &[Vec<&Curve>],
    over: &str,
) -> Result<(), DrawingAreaErrorKind<B::ErrorType>> {
    area.fill(&WHITE)?;
    let title = format!("{} ({} samples)", track.name, track.samples);
    let area = area.titled(&title, ("sans-serif", 20))?;
    let times = || panels.iter().flatten().flat_map(|curve| curve.points.iter().map(|point| point.0));
    let (begin, end) = range(times(), 0.0);
    let names = || panels.iter().flatten().map(|curve| curve.path.as_str());
    let mut widest = 0;
    for name in names() {
        let (width, _) = area.estimate_text_size(name, &TextStyle::from(LEGEND))?;
        widest = widest.max(i32::try_from(width).unwrap_or_default());
    }
    let (width, _) = area.dim_in_pixel();
    let width = i32::try_from(width).unwrap_or(i32::MAX);
    // Beside the curves, so that it hides none; in a narrow picture long names are cut off.
    let legend = (widest + MARK + 24).min(width / 2);
    let last = panels.len().saturating_sub(1);
    for ((index, panel), area) in panels.iter().enumerate().zip(area.split_evenly((panels.len(), 1))) {
        let (area, beside) = area.split_horizontally(width - legend);
        let unit = panel.first().map_or("", |curve| curve.unit);
        let values = panel.iter().flat_map(|curve| curve.points.iter().map(|point| point.1));
        let (low, high) = range(values, 0.05);
        let (_, height) = area.dim_in_pixel();
        let mut chart = ChartBuilder::on(&area)
            .margin(10)
            .x_label_area_size(if index == last { 36 } else { 18 })
            .y_label_area_size(64)
            .build_cartesian_2d(begin..end, low..high)?;
        let mut mesh = chart.configure_mesh();
        mesh.label_style(("sans-serif", 14))
            .axis_desc_style(("sans-serif", 15))
            .y_labels(usize::try_from(height / 30).unwrap_or_default().clamp(2, 10))
            .y_desc(if unit.is_empty() { "value" } else { unit })
            .light_line_style(WHITE)
            .bold_line_style(RGBColor(225, 225, 225));
        if index == last {
            mesh.x_desc(over);
        }
        mesh.draw()?;
        let rows = i32::try_from(panel.len()).unwrap_or(i32::MAX).max(1);
        let pitch = ((i32::try_from(height).unwrap_or(i32::MAX) - 10) / rows).clamp(1, 18);
        for ((curve, number), row) in panel.iter().zip(0..).zip(0..) {
            let color = COLORS[number % COLORS.len()];
            let style = color.stroke_width(if number < COLORS.len() { 2 } else { 1 });
            chart.draw_series(LineSeries::new(curve.points.iter().copied(), style))?;
            let y = 16 + pitch * row;
            beside.draw(&PathElement::new([(4, y), (4 + MARK, y)], style))?;
            let left = TextStyle::from(LEGEND).pos(Pos::new(HPos::Left, VPos::Center));
            beside.draw(&Text::new(curve.path.as_str(), (MARK + 10, y), left))?;
        }
    }
    area.present()
}

/// The range of values, wider by `margin` on each side; never empty.
fn range(values: impl Iterator<Item = f64>, margin: f64) -> (f64, f64) {
    let (low, high) = values
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)));
    if !low.is_finite() || !high.is_finite() {
        return (0.0, 1.0);
    }
    let width = high - low;
    if width <= 0.0 {
        let around = low.abs().max(1.0) * 0.5;
        return (low - around, high + around);
    }
    (low - width * margin, high + width * margin)
}
