//! Numbers against numbers as a picture: lines and points, both scales logarithmic.

use plotters::prelude::*;

/// A picture of lines.
#[derive(Debug, Clone, Copy)]
pub struct Plot<'a> {
    /// What stands above it.
    pub title: &'a str,
    /// What is counted to the right.
    pub x: &'a str,
    /// What is counted upwards.
    pub y: &'a str,
    /// Names of lines, and their points in order. A number that is not positive stands at the lower edge.
    pub lines: &'a [(String, Vec<(f64, f64)>)],
}

/// A picture that cannot be drawn.
#[derive(Debug, thiserror::Error)]
#[error("the picture cannot be drawn: {0}")]
pub struct NoPlot(String);

/// Size of the picture, in pixels of SVG.
const SIZE: (u32, u32) = (760, 460);

/// Colours of the series that can be told apart by all eyes (Okabe and Ito 2008).
const COLORS: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(0, 0, 0),
];

impl Plot<'_> {
    /// The picture as SVG.
    ///
    /// # Errors
    /// Numbers that are not finite.
    pub fn svg(&self) -> Result<String, NoPlot> {
        let mut text = String::new();
        self.draw(&mut text).map_err(|error| NoPlot(error.to_string()))?;
        Ok(text)
    }

    fn draw(&self, text: &mut String) -> Result<(), Box<dyn std::error::Error>> {
        let area = SVGBackend::with_string(text, SIZE).into_drawing_area();
        area.fill(&WHITE)?;
        let (across, up) = (self.range(|point| point.0)?, self.range(|point| point.1)?);
        let least = (across.start, up.start);
        let mut chart = ChartBuilder::on(&area)
            .caption(self.title, ("sans-serif", 18))
            .margin(12)
            .x_label_area_size(44)
            .y_label_area_size(72)
            .build_cartesian_2d(across.log_scale(), up.log_scale())?;
        chart
            .configure_mesh()
            .x_desc(self.x)
            .y_desc(self.y)
            .x_label_formatter(&|x| format!("{x:e}"))
            .y_label_formatter(&|y| format!("{y:e}"))
            .draw()?;
        for ((name, points), color) in self.lines.iter().zip(COLORS.into_iter().cycle()) {
            let points = points.iter().map(|(x, y)| (x.max(least.0), y.max(least.1)));
            chart
                .draw_series(LineSeries::new(points.clone(), color.stroke_width(2)))?
                .label(name)
                .legend(move |(x, y)| PathElement::new([(x, y), (x + 18, y)], color.stroke_width(2)));
            chart.draw_series(points.map(|at| Circle::new(at, 3, color.filled())))?;
        }
        // The corner that the lines leave free.
        let rising = self.lines.iter().any(|(_, points)| {
            points.first().zip(points.last()).is_some_and(|(first, last)| last.1 > first.1)
        });
        chart
            .configure_series_labels()
            .position(if rising { SeriesLabelPosition::UpperLeft } else { SeriesLabelPosition::UpperRight })
            .background_style(WHITE.mix(0.85))
            .border_style(BLACK)
            .draw()?;
        area.present()?;
        Ok(())
    }

    /// From below the least positive number to above the largest.
    fn range(&self, value: impl Fn(&(f64, f64)) -> f64) -> Result<std::ops::Range<f64>, NoPlot> {
        let values: Vec<f64> = self.lines.iter().flat_map(|(_, points)| points).map(value).collect();
        if let Some(odd) = values.iter().find(|value| !value.is_finite()) {
            return Err(NoPlot(format!("there is no place for {odd}")));
        }
        let positive = values.into_iter().filter(|value| *value > 0.0);
        let (least, most) = positive.fold((f64::INFINITY, 0.0_f64), |(l, m), v| (l.min(v), m.max(v)));
        Ok(if most == 0.0 { 0.1..1.0 } else { least / 2.0..most * 2.0 })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_names_its_lines_and_axes() {
        let lines = [("plain".to_owned(), vec![(1.0, 10.0), (100.0, 0.0)]), ("bare".to_owned(), vec![])];
        let svg = Plot { title: "Title", x: "cost", y: "error", lines: &lines }.svg().unwrap();
        for word in ["<svg", "Title", "cost", "error", "plain", "bare", "</svg>"] {
            assert!(svg.contains(word), "{word}");
        }
    }

    #[test]
    fn what_is_no_number_is_refused() {
        let lines = [("plain".to_owned(), vec![(1.0, f64::NAN)])];
        assert!(Plot { title: "", x: "", y: "", lines: &lines }.svg().is_err());
    }
}
