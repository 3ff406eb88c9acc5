//! How `monitor` looks. Everything is readable without colors.

use ratatui::Frame;
use ratatui::layout::{Constraint, Layout, Rect};
use ratatui::style::{Color, Modifier, Style};
use ratatui::symbols::Marker;
use ratatui::text::{Line, Span};
use ratatui::widgets::canvas::{Canvas, Circle, Line as Stroke};
use ratatui::widgets::{Axis as Scale, Block, Chart, Dataset, GraphType, Paragraph, Row, Table};

use super::view::{NAMES, PAST, View};

/// Draws everything, as far as there is room.
pub(super) fn draw(frame: &mut Frame<'_>, view: &View) {
    let [title, top, state, plots, keys] = Layout::vertical([
        Constraint::Length(1),
        Constraint::Length(11),
        Constraint::Length(3),
        Constraint::Min(0),
        Constraint::Length(1),
    ])
    .areas(frame.area());
    let name = Style::new().add_modifier(Modifier::BOLD);
    frame.render_widget(Paragraph::new(view.title.as_str()).style(name), title);
    let [horizon, axes] = Layout::horizontal([Constraint::Length(26), Constraint::Min(0)]).areas(top);
    attitude(frame, horizon, view);
    table(frame, axes, view);
    condition(frame, state, view);
    let areas: [Rect; 3] = Layout::horizontal([Constraint::Ratio(1, 3); 3]).areas(plots);
    for (index, area) in areas.into_iter().enumerate() {
        plot(frame, area, view, index);
    }
    let pause = if view.paused { "p goes on (paused)" } else { "p pauses" };
    frame.render_widget(Paragraph::new(format!("q ends  {pause}  c clears the plots")), keys);
}

/// A color, where there are any.
fn color(view: &View, color: Color) -> Color {
    if view.colored { color } else { Color::Reset }
}

/// The horizon as the camera sees it: tilted by roll, shifted by pitch; the line below shows the heading.
fn attitude(frame: &mut Frame<'_>, area: Rect, view: &View) {
    let [roll, pitch, yaw] = [0, 1, 2].map(|index| view.axes.get(index).map_or(0.0, |axis| axis.angle));
    let (sky, camera) = (color(view, Color::Cyan), color(view, Color::Yellow));
    let canvas = Canvas::default()
        .block(Block::bordered().title("attitude"))
        .marker(Marker::Braille)
        .x_bounds([-1.2, 1.2])
        .y_bounds([-1.2, 1.2])
        .paint(move |context| {
            context.draw(&Circle { x: 0.0, y: 0.0, radius: 1.0, color: Color::Reset });
            // Lines of equal pitch; that of 0 is the horizon. 45 degrees of pitch are the whole circle.
            for line in [-60.0, -40.0, -20.0, 0.0, 20.0, 40.0, 60.0] {
                let half: f64 = if line == 0.0 { 0.9 } else { 0.25 };
                let height: f64 = (line - pitch) / 45.0;
                let room = (1.0 - height * height).max(0.0).sqrt().min(half);
                if height.abs() < 1.0 {
                    let (sin, cos) = (-roll).to_radians().sin_cos();
                    let turn = |x: f64| (x * cos - height * sin, x * sin + height * cos);
                    let ((x1, y1), (x2, y2)) = (turn(-room), turn(room));
                    context.draw(&Stroke { x1, y1, x2, y2, color: sky });
                }
            }
            // Where the camera points.
            for (from, to) in [(-0.45, -0.15), (0.15, 0.45)] {
                context.draw(&Stroke { x1: from, y1: 0.0, x2: to, y2: 0.0, color: camera });
            }
            context.draw(&Stroke { x1: 0.0, y1: -0.12, x2: 0.0, y2: 0.12, color: camera });
            context.print(-1.15, -1.15, Line::from(format!("heading {yaw:.0}\u{B0}")));
        });
    frame.render_widget(canvas, area);
}

/// Angles, targets and motors of the axes as numbers and bars.
fn table(frame: &mut Frame<'_>, area: Rect, view: &View) {
    let bar = usize::from(area.width.saturating_sub(44)).clamp(4, 40);
    let rows = NAMES.iter().zip(&view.axes).map(|(name, axis)| {
        let error = (axis.angle - axis.target + 180.0).rem_euclid(360.0) - 180.0;
        Row::new([
            (*name).to_owned(),
            format!("{:>8.2}\u{B0}", axis.angle),
            format!("{:>8.2}\u{B0}", axis.target),
            format!("{error:>7.2}\u{B0}"),
            format!("{} {:>3.0}%", gauge(axis.power, bar), axis.power),
        ])
    });
    let bar = u16::try_from(bar).unwrap_or(40);
    let widths = [5, 9, 9, 8, bar + 7].map(Constraint::Length);
    let bold = Style::new().add_modifier(Modifier::BOLD);
    let header = Row::new(["axis", "   angle", "   target", "   error", "motor power"]).style(bold);
    let state = if view.motors_on { "motors ON" } else { "motors off" };
    let title = format!("axes, {state}, {}", view.profile);
    let table = Table::new(rows, widths).header(header).block(Block::bordered().title(title));
    frame.render_widget(table, area);
}

/// A bar of `width` characters for `percent`.
fn gauge(percent: f64, width: usize) -> String {
    let full = (0..width).filter(|&place| {
        #[allow(clippy::cast_precision_loss, reason = "a bar is short")]
        let begin = place as f64 / width as f64 * 100.0;
        begin < percent
    });
    let full = full.count();
    format!("[{}{}]", "#".repeat(full), ".".repeat(width - full))
}

/// Battery, errors and link.
fn condition(frame: &mut Frame<'_>, area: Rect, view: &View) {
    let battery = match view.battery {
        Some(volts) => format!("battery {volts:.2} V"),
        None => String::from("battery -"),
    };
    let errors = view.errors.as_deref().unwrap_or("none");
    let bad = Style::new().fg(color(view, Color::Red)).add_modifier(Modifier::BOLD);
    let style = |bad_now: bool| if bad_now { bad } else { Style::new() };
    let (i2c, serial) = (view.i2c_errors, view.serial_errors);
    let first = Line::from(vec![
        Span::raw(battery),
        Span::raw("   errors: "),
        Span::styled(errors.to_owned(), style(view.errors.is_some())),
    ]);
    let second = Line::from(vec![
        Span::styled(format!("sensor bus errors {i2c}"), style(i2c > 0)),
        Span::raw("   "),
        Span::styled(format!("serial errors of the board {serial}"), style(serial > 0)),
    ]);
    let (link, skipped) = (&view.link, view.link.received.skipped());
    let frames = link.received.frames;
    let third = Line::from(vec![
        Span::raw(format!("link: {:.0} samples/s, {frames} frames, ", view.rate)),
        Span::styled(format!("{skipped} bytes skipped"), style(skipped > 0)),
        Span::raw(", "),
        Span::styled(format!("{} lost", view.lost), style(view.lost > 0)),
        Span::raw(", "),
        Span::styled(format!("{} time-outs", link.timeouts), style(link.timeouts > 0)),
    ]);
    frame.render_widget(Paragraph::new(vec![first, second, third]), area);
}

/// One axis over time: dots are the angle, the line is the target.
fn plot(frame: &mut Frame<'_>, area: Rect, view: &View, index: usize) {
    let (Some(axis), Some(name)) = (view.axes.get(index), NAMES.get(index)) else { return };
    let angles: Vec<_> = axis.angles.iter().copied().collect();
    let targets: Vec<_> = axis.targets.iter().copied().collect();
    let all = || angles.iter().chain(&targets).map(|point| point.1);
    let low = all().fold(f64::INFINITY, f64::min);
    let high = all().fold(f64::NEG_INFINITY, f64::max);
    let (low, high) = if low.is_finite() { (low, high) } else { (0.0, 0.0) };
    let room = ((high - low) * 0.1).max(1.0);
    let (low, high) = (low - room, high + room);
    let line = Dataset::default()
        .marker(Marker::Braille)
        .graph_type(GraphType::Line)
        .style(Style::new().fg(color(view, Color::DarkGray)))
        .data(&targets);
    let dots = Dataset::default()
        .marker(Marker::Dot)
        .graph_type(GraphType::Scatter)
        .style(Style::new().fg(color(view, Color::Green)))
        .data(&angles);
    let chart = Chart::new(vec![line, dots])
        .block(Block::bordered().title(format!("{name}, {PAST:.0} s")))
        .x_axis(Scale::default().bounds([view.now - PAST, view.now.max(0.001)]))
        .y_axis(Scale::default().bounds([low, high]).labels([format!("{low:.0}"), format!("{high:.0}")]));
    frame.render_widget(chart, area);
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use ratatui::Terminal;
    use ratatui::backend::TestBackend;
    use ratatui::buffer::Buffer;
    use sbgc_proto::commands::{BoardInfo, RealtimeData3, RtDataFlags, SystemErrors};
    use sbgc_proto::frame::Version;
    use sbgc_proto::units::{Angle, Voltage};
    use sbgc_proto::wire::PerAxis;

    use super::*;

    fn screen(view: &View, width: u16, height: u16) -> Buffer {
        let mut terminal = Terminal::new(TestBackend::new(width, height)).unwrap();
        terminal.draw(|frame| draw(frame, view)).unwrap();
        terminal.backend().buffer().clone()
    }

    fn text(buffer: &Buffer) -> String {
        let cells = buffer.content().chunks(usize::from(buffer.area.width));
        let lines: Vec<String> =
            cells.map(|line| line.iter().map(ratatui::buffer::Cell::symbol).collect()).collect();
        lines.join("\n")
    }

    fn view(colored: bool) -> View {
        let mut view = View::new("sim", &BoardInfo::default(), Version::V2, colored);
        for step in 0_i16..20 {
            let pitch = Angle::from_degrees(-f32::from(step));
            let data = RealtimeData3 {
                imu_angle: PerAxis { roll: Angle::from_degrees(12.5), pitch, yaw: Angle::from_degrees(90.0) },
                target_angle: PerAxis { roll: Angle::default(), pitch, yaw: Angle::from_degrees(90.0) },
                bat_level: Voltage::from_volts(14.8),
                rt_data_flags: RtDataFlags::MOTORS_ON,
                motor_power: PerAxis { roll: 0, pitch: 255, yaw: 128 },
                i2c_error_count: 3,
                ..RealtimeData3::default()
            };
            view.add(Duration::from_millis(50 * u64::try_from(step).unwrap()), &data);
        }
        view
    }

    #[test]
    fn everything_fits_a_small_terminal() {
        let text = text(&screen(&view(false), 80, 24));
        for part in [
            "sim: board",
            "version 2",
            "ROLL",
            "PITCH",
            "YAW",
            "12.50°",
            "-19.01°",
            "90.00°",
            "motors ON",
            "100%",
            " 50%",
            "  0%",
            "battery 14.80 V",
            "errors: none",
            "sensor bus errors 3",
            "20 samples/s",
            "heading 90°",
            "PITCH, 30 s",
            "q ends",
            "p pauses",
        ] {
            assert!(text.contains(part), "{part:?} is not in:\n{text}");
        }
        assert!(text.lines().any(|line| line.contains("[####")), "a full bar of a motor:\n{text}");
        // The picture is made of dots.
        assert!(text.chars().filter(|dot| ('\u{2801}'..='\u{28FF}').contains(dot)).count() > 20, "{text}");
    }

    #[test]
    fn without_colors_there_are_none() {
        let colors = |colored: bool| {
            let buffer = screen(&view(colored), 80, 24);
            buffer.content().iter().filter(|cell| cell.fg != Color::Reset || cell.bg != Color::Reset).count()
        };
        assert_eq!(colors(false), 0);
        assert!(colors(true) > 0);
    }

    #[test]
    fn errors_have_names() {
        let mut view = view(false);
        let data = RealtimeData3 { system_error: SystemErrors::all(), ..RealtimeData3::default() };
        view.add(Duration::from_secs(2), &data);
        let shown = text(&screen(&view, 200, 24));
        let names: Vec<_> = SystemErrors::LABELS.iter().map(|label| label.name).collect();
        assert!(shown.contains(names[0]), "{shown}");
        assert!(shown.contains("motors off"), "{shown}");
    }

    #[test]
    fn the_horizon_moves() {
        let at = |pitch: f32, roll: f32| {
            let mut view = view(false);
            let imu_angle = PerAxis {
                roll: Angle::from_degrees(roll),
                pitch: Angle::from_degrees(pitch),
                yaw: Angle::default(),
            };
            view.add(Duration::from_secs(3), &RealtimeData3 { imu_angle, ..RealtimeData3::default() });
            let buffer = screen(&view, 80, 24);
            text(&buffer)
                .lines()
                .skip(1)
                .take(11)
                .map(|line| line.chars().take(26).collect())
                .collect::<Vec<String>>()
        };
        assert_ne!(at(0.0, 0.0), at(20.0, 0.0), "pitch shifts it");
        assert_ne!(at(0.0, 0.0), at(0.0, 30.0), "roll tilts it");
        assert_eq!(at(0.0, 30.0), at(0.0, 30.0));
    }

    #[test]
    fn a_pause_stops_the_picture_and_clearing_empties_the_plots() {
        let mut view = view(false);
        view.pause();
        view.add(Duration::from_secs(9), &RealtimeData3::default());
        assert!(text(&screen(&view, 80, 24)).contains("-19.01°"));
        assert!(text(&screen(&view, 80, 24)).contains("(paused)"));
        view.clear();
        assert!(view.axes.iter().all(|axis| axis.angles.is_empty()));
    }

    #[test]
    fn no_size_is_too_small() {
        for (width, height) in [(1, 1), (10, 5), (40, 12), (300, 100)] {
            screen(&view(true), width, height);
        }
    }
}
